// SPDX-License-Identifier: Apache-2.0
// SurfaceRemesherCLI reads closed surfaces and writes the same surfaces at other densities.

#include "CommandLine.h"
#include "Errors.h"
#include "JsonReport.h"
#include "MeshChecks.h"
#include "MeshIO.h"
#include "PrintableText.h"
#include "Structures.h"
#include "SurfaceComparison.h"
#include "SurfaceEdgeLength.h"
#include "SurfaceRemesherCLIXML.h"
#include "SurfaceRemeshing.h"
#include "SurfaceValidity.h"
#include "TextFile.h"
#include "TissueMapIO.h"
#include "TissueSurfaces.h"

#include <vtkSMPTools.h>

#include <cmath>
#include <sstream>

using namespace surgicalmesher;

namespace
{

/// Checks what the command line alone determines.
void requireUsableOptions(const CommandLine& line)
{
  if (!line.text("scale").empty() && line.number("edgeLength") > 0)
    throw UsageError("--scale and --edgeLength are both given, expected one of them");
}

/// Reads a surface that is labelled, closed around every tissue and free of self-intersections.
SurfaceFile readOriginal(CommandLine& line)
{
  const std::string file = line.text("surface");
  SurfaceFile content = readSurface(file);
  SurfaceComplex& surface = content.surface;
  if (surface.labels.empty())
  {
    surface = closedShellsToTissues(surface, file);
    content.targetEdgeLength.clear(); // points have been merged
    return content;
  }
  const std::size_t points = surface.points.size();
  surface = withoutDuplicatePoints(surface);
  if (surface.points.size() != points) content.targetEdgeLength.clear();
  if (const auto sole = leaveNeighboursOut(surface))
    line.message(file + " is the surface of tissue " + std::to_string(*sole) + " alone: its neighbours become outside");
  requireFillable(surface, file);
  return content;
}

double diagonalOf(const SurfaceComplex& surface)
{
  Box box = Box::around(surface.points.at(0));
  for (const Vec3& p : surface.points) box.add(p);
  return norm(box.high - box.low);
}

SizingFunction readEdgeLength(const CommandLine& line, const SurfaceFile& original)
{
  const double uniform = line.number("edgeLength");
  if (uniform > 0) return [uniform](const Vec3&) { return uniform; };
  if (const std::string file = line.text("scale"); !file.empty())
  {
    const ScaleField scale = readScale(file);
    requireCover(scale, original.surface.points, file);
    return [scale](const Vec3& p) { return scale(p); };
  }
  if (!original.targetEdgeLength.empty())
    return edgeLengthFromPoints(original.surface.points, original.targetEdgeLength);
  if (!(line.number("chordError") > 0))
    throw UsageError("no --scale, neither --edgeLength nor --chordError above 0, and " + line.text("surface") +
                     " has no point array TargetEdgeLength, expected one of them");
  constexpr double longest = 0.1; // relative to the diagonal
  return [length = longest * diagonalOf(original.surface)](const Vec3&) { return length; };
}

struct Comparison
{
  std::map<Label, TissueSurface> before, after;
  SurfaceDistance toOriginal, fromOriginal;
};

/// Throws EngineError if a tissue has changed its topology.
Comparison compare(const SurfaceComplex& original, const SurfaceComplex& remeshed)
{
  requireSound(remeshed, "remeshing");
  Comparison result{ checkSurface(original), checkSurface(remeshed), surfaceDistance(remeshed, original),
                     surfaceDistance(original, remeshed) };
  for (const auto& [label, tissue] : result.before)
    if (const auto at = result.after.find(label); at == result.after.end() || at->second.euler != tissue.euler)
      throw EngineError("remeshing: tissue " + std::to_string(label) + " changed its topology");
  return result;
}

void writeDistance(JsonWriter& json, const char* key, const SurfaceDistance& distance)
{
  json.Key(key);
  json.StartObject();
  writeMember(json, "mean", distance.mean);
  writeMember(json, "maximum", distance.maximum);
  writeMember(json, "where", distance.where);
  json.EndObject();
}

void writeTriangles(JsonWriter& json, const char* key, const SurfaceComplex& surface)
{
  const TriangleQuality quality = triangleQuality(surface);
  json.Key(key);
  json.StartObject();
  writeMember(json, "triangles", surface.triangles.size());
  writeMember(json, "points", surface.points.size());
  writeMember(json, "smallestAngle", quality.smallestAngle.minimum);
  writeMember(json, "meanSmallestAngle", quality.smallestAngle.mean);
  writeMember(json, "meanEdge", quality.edgeLength.mean);
  writeMember(json, "edgeVariation", quality.edgeVariation);
  json.EndObject();
}

/// Returns the report: lengths in mm, angles in degrees, volumes in mm^3, positions in LPS.
std::string reportJSON(const CommandLine& line, const SurfaceFile& original, const RemeshedSurface& remeshed,
                       const Comparison& comparison)
{
  const auto writeTissue = [&](JsonWriter& json, Label label, const TissueSurface& before)
  {
    const TissueSurface& after = comparison.after.at(label);
    writeMember(json, "label", label);
    writeMember(json, "name", printable(nameOf(label, original.tissues)));
    writeMember(json, "triangles", after.triangles);
    writeMember(json, "euler", after.euler);
    writeMember(json, "volumeBefore", before.volume);
    writeMember(json, "volume", after.volume);
  };
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "module", std::string("SurfaceRemesher"));
    writeObject(json, "parameters",
                [&]
                {
                  for (const char* name : { "edgeLength", "chordError", "featureAngle" })
                    writeMember(json, name, line.number(name));
                });
    writeTriangles(json, "original", original.surface);
    writeTriangles(json, "remeshed", remeshed.surface);
    writeMember(json, "sharpEdges", remeshed.sharpEdges);
    writeDistance(json, "toOriginal", comparison.toOriginal);
    writeDistance(json, "fromOriginal", comparison.fromOriginal);
    writeObjects(json, "tissues", comparison.before,
                 [&](const auto& tissue) { writeTissue(json, tissue.first, tissue.second); });
    writeWarnings(json, line.warnings());
  };
  return jsonText(writeMembers, { 6 });
}

/// The guards enforce the chord error only at samples, and accept triangles no worse than those they replace.
void warnOfChordError(CommandLine& line, const Comparison& comparison)
{
  const double bound = line.number("chordError");
  const double found = std::max(comparison.toOriginal.maximum, comparison.fromOriginal.maximum);
  if (!(bound > 0) || found <= bound) return;
  std::ostringstream text;
  text << "the surface is up to " << std::round(found * 1000) / 1000 << " mm from the original, more than the " << bound
       << " mm of --chordError";
  line.warning(text.str());
}

void run(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  requireUsableOptions(line);
  const SurfaceFile original = readOriginal(line);
  RemeshingOptions options;
  options.edgeLength = readEdgeLength(line, original);
  options.chordError = line.number("chordError");
  options.featureAngle = line.number("featureAngle");
  const RemeshedSurface remeshed = remeshSurface(original.surface, options, subProgress(progress, 0.05, 0.9));

  report(progress, 0.9, "checks");
  const Comparison comparison = compare(original.surface, remeshed.surface);
  warnOfChordError(line, comparison);
  report(progress, 0.95, "writing");
  SurfaceFile content;
  content.surface = remeshed.surface;
  content.targetEdgeLength = remeshed.edgeLength;
  content.tissues = original.tissues;
  writeSurface(content, line.outputFile("remeshed"));
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty()) writeBytes(reportJSON(line, original, remeshed, comparison), reportFile);
  const std::size_t triangles = remeshed.surface.triangles.size();
  line.message(std::to_string(original.surface.triangles.size()) + " triangles became " + std::to_string(triangles));
  line.returnValue("triangleCount", std::to_string(triangles));
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
