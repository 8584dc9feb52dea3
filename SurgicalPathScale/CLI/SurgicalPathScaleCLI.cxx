// SPDX-License-Identifier: Apache-2.0
// SurgicalPathScaleCLI reads a label map, targets and paths, and writes the scale volume, the null-displacement map and
// an estimate of the mesh size.

#include "CommandLine.h"
#include "Errors.h"
#include "IntensityImage.h"
#include "JsonReport.h"
#include "MemoryEstimate.h"
#include "MeshSizeEstimate.h"
#include "NullDisplacement.h"
#include "Place.h"
#include "RepeatedVoxels.h"
#include "SurgicalPathScaleCLIXML.h"
#include "SurgicalScale.h"
#include "TextFile.h"
#include "TissueLengths.h"
#include "TissueMapIO.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace surgicalmesher;

namespace
{

/// Results of the run for the report and for return values.
struct Results
{
  std::size_t tissueCount = 0;
  float shortest = 0;
  float longest = 0;
  NullDisplacement nullDisplacement;
  MeshSizeEstimate estimate;
  MeshingSize meshing;                                    ///< without repeated voxels
  std::uint64_t surfaceMemory = 0, tetrahedralMemory = 0; ///< bytes
};

/// Returns the count rounded to three significant digits, without an exponent.
std::string roundedCount(double count)
{
  const double unit = count < 1000 ? 1 : std::pow(10.0, std::floor(std::log10(count)) - 2);
  return std::to_string(std::llround(count / unit) * std::llround(unit));
}

Combination readCombination(const CommandLine& line)
{
  const std::string combine = line.text("combine");
  if (combine == "targets") return Combination::Targets;
  return combine == "path" ? Combination::Paths : Combination::Smaller;
}

/// Reads the range from the areas, if they are given; edge lengths equal to the defaults then count as not given.
void readAreas(const CommandLine& line, SurgicalScaleOptions& options)
{
  const double minimum = line.number("minimumArea"), maximum = line.number("maximumArea");
  if (minimum == 0 && maximum == 0) return;
  if (minimum == 0 || maximum == 0)
    throw UsageError("one of --minimumArea and --maximumArea is given, expected both or none");
  const LengthRange defaults;
  if (options.range.minimum != defaults.minimum || options.range.maximum != defaults.maximum)
    throw UsageError("areas and edge lengths are given, expected --minimumArea and --maximumArea or "
                     "--minimumEdgeLength and --maximumEdgeLength");
  if (minimum > maximum)
    throw UsageError("the minimum area, " + text::rounded(minimum, 6) + " mm^2, is above the maximum, " +
                     text::rounded(maximum, 6) + " mm^2");
  options.range = { edgeLengthOfArea(minimum), edgeLengthOfArea(maximum) };
  options.rising = RisingQuantity::Area;
}

/// Reads all options except the lengths of single tissues, which need the names of the map.
SurgicalScaleOptions readOptions(const CommandLine& line)
{
  const auto orElse = [](double value, double fallback) { return value > 0 ? value : fallback; };
  SurgicalScaleOptions options;
  options.range = { line.number("minimumEdgeLength"), line.number("maximumEdgeLength") };
  readAreas(line, options);
  options.targetFalloff = { line.number("childRadius"), line.number("decayLength") };
  options.pathFalloff.childRadius = orElse(line.number("pathChildRadius"), options.targetFalloff.childRadius);
  options.pathFalloff.decayLength = orElse(line.number("pathDecayLength"), options.targetFalloff.decayLength);
  options.combination = readCombination(line);
  options.gradation = line.number("gradation");
  options.spacing = line.number("spacing");
  return options;
}

NullDisplacementOptions readNullDisplacement(const CommandLine& line, const TissueMap& map,
                                             const std::set<Label>& named)
{
  const std::vector<Label> present = presentLabels(map);
  NullDisplacementOptions options;
  options.targetRadius = line.number("nullDisplacementRadius");
  options.pathDistance = line.number("nullDisplacementPathDistance");
  options.pathDistanceAtTarget = line.number("nullDisplacementPathDistanceAtTarget");
  options.named = named;
  const std::string tissues = line.text("nullDisplacementTissues");
  if (text::trimmed(tissues).empty()) return options;
  for (const std::string& tissue : text::splitFields(tissues))
  {
    Label label = 0;
    if (!findTissue(tissue, map.table, label))
      throw UsageError("--nullDisplacementTissues: " + whyNoTissue(tissue, map.table));
    if (!std::binary_search(present.begin(), present.end(), label))
      throw UsageError("--nullDisplacementTissues: no voxel of tissue " + tissue + " in the label map");
    options.tissues.insert(label);
  }
  return options;
}

bool isInside(const Grid& grid, const Vec3& world)
{
  const Vec3 p = grid.worldToGrid(world);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double index = p[axis] / grid.spacing[axis];
    if (index < -0.5 || index > grid.size[axis] - 0.5) return false;
  }
  return true;
}

void warnOfOddities(CommandLine& line, const TissueMap& map, const Focus& focus, const SurgicalScaleOptions& options)
{
  const std::string intensities = likenessToIntensities(map);
  if (!intensities.empty()) line.warning(line.text("labelMap") + ": " + intensities);
  const auto warnIfOutside = [&](const char* what, const std::vector<Vec3>& points)
  {
    for (const Vec3& p : points)
    {
      if (isInside(map.grid, p)) continue;
      line.warning(what + (" " + place(p)) + " LPS lies outside the label map");
    }
  };
  warnIfOutside("target", focus.targets);
  for (const Path& path : focus.paths) warnIfOutside("path point", path);
  const std::vector<Label> present = presentLabels(map);
  for (const auto& tissue : options.tissues)
  {
    if (std::binary_search(present.begin(), present.end(), tissue.first)) continue;
    line.warning("tissue " + std::to_string(tissue.first) + " has lengths of its own, but no voxel in the label map");
  }
}

/// Returns the length rounded down to two significant digits.
std::string roundedDown(double length)
{
  const double unit = std::pow(10.0, std::floor(std::log10(length)) - 1);
  return text::rounded(std::floor(length / unit) * unit, 2);
}

void warnOfLargeVoxels(CommandLine& line, const Focus& focus, const SurgicalScaleOptions& options)
{
  const double sufficient = sufficientSpacing(options, focus.targets, focus.paths);
  if (options.spacing <= sufficient) return;
  line.warning("the scale volume's voxels of " + text::rounded(options.spacing, 3) +
               " mm are too large for lengths that rise so soon, and edges may be too long at targets and paths; " +
               "expected --spacing " + roundedDown(sufficient) + " or less, or a larger child radius or decay length");
}

void writeParameters(JsonWriter& json, const SurgicalScaleOptions& options, const CommandLine& line)
{
  json.Key("parameters");
  json.StartObject();
  writeMember(json, "minimumEdgeLength", options.range.minimum);
  writeMember(json, "maximumEdgeLength", options.range.maximum);
  writeMember(json, "rising", std::string(options.rising == RisingQuantity::Area ? "area" : "length"));
  writeMember(json, "childRadius", options.targetFalloff.childRadius);
  writeMember(json, "decayLength", options.targetFalloff.decayLength);
  writeMember(json, "pathChildRadius", options.pathFalloff.childRadius);
  writeMember(json, "pathDecayLength", options.pathFalloff.decayLength);
  writeMember(json, "combine", line.text("combine"));
  writeMember(json, "spacing", options.spacing);
  writeMember(json, "gradation", options.gradation);
  writeMember(json, "tissuesWithOwnLengths", options.tissues.size());
  writeMember(json, "nullDisplacementRadius", line.number("nullDisplacementRadius"));
  writeMember(json, "nullDisplacementPathDistance", line.number("nullDisplacementPathDistance"));
  writeMember(json, "nullDisplacementPathDistanceAtTarget", line.number("nullDisplacementPathDistanceAtTarget"));
  json.EndObject();
}

void writeFocus(JsonWriter& json, const Focus& focus)
{
  writeMember(json, "targets", focus.targets);
  writeObjects(json, "paths", focus.paths,
               [&](const Path& path)
               {
                 writeMember(json, "length", pathLength(path));
                 writeMember(json, "points", path);
               });
}

void writeResults(JsonWriter& json, const Results& results, const std::vector<std::string>& warnings, const Grid& map,
                  const Grid& scale)
{
  const double voxelVolume = map.spacing.x * map.spacing.y * map.spacing.z;
  writeObject(json, "map",
              [&]
              {
                writeMember(json, "size", map.size);
                writeMember(json, "tissues", results.tissueCount);
              });
  writeObject(json, "scale",
              [&]
              {
                writeMember(json, "size", scale.size);
                writeMember(json, "shortest", results.shortest);
                writeMember(json, "longest", results.longest);
              });
  writeObject(json, "nullDisplacement",
              [&]
              {
                writeMember(json, "label", results.nullDisplacement.label);
                writeMember(json, "voxels", results.nullDisplacement.voxelCount);
                writeMember(json, "volume", double(results.nullDisplacement.voxelCount) * voxelVolume);
              });
  writeObject(json, "estimate",
              [&]
              {
                writeMember(json, "triangles", std::int64_t(std::llround(results.estimate.triangles)));
                writeMember(json, "tetrahedra", std::int64_t(std::llround(results.estimate.tetrahedra)));
                writeMember(json, "meshedVoxels", results.meshing.voxels);
                writeMember(json, "voxelFaces", std::int64_t(std::llround(results.meshing.faces)));
                writeMember(json, "startingFaces", std::int64_t(std::llround(results.meshing.startingFaces)));
                writeMember(json, "surfaceMemoryBytes", std::int64_t(results.surfaceMemory));
                writeMember(json, "tetrahedralMemoryBytes", std::int64_t(results.tetrahedralMemory));
              });
  writeWarnings(json, warnings);
}

/// Writes lengths in mm, points in LPS, volumes in mm^3.
void writeReport(const std::string& file, const CommandLine& line, const Focus& focus,
                 const SurgicalScaleOptions& options, const Results& results, const Grid& map, const Grid& scale)
{
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "module", std::string("SurgicalPathScale"));
    writeMember(json, "labelMap", line.text("labelMap"));
    writeFocus(json, focus);
    writeParameters(json, options, line);
    writeResults(json, results, line.warnings(), map, scale);
  };
  writeBytes(jsonText(writeMembers, { 6 }), file);
}

/// Marks null-displacement tissue. The written map has repeated voxels as often as the input file.
void markFarTissue(CommandLine& line, TissueMap& map, const Focus& focus, const std::set<Label>& named,
                   const VoxelRepeats& repeats, Results& results)
{
  const std::string file = line.outputFile("outputLabelMap");
  const bool isAskedFor = line.number("nullDisplacementRadius") > 0 || line.number("nullDisplacementPathDistance") > 0;
  if (file.empty() && isAskedFor) line.warning("null displacement goes nowhere without --outputLabelMap");
  if (file.empty()) return;
  results.nullDisplacement =
    markNullDisplacement(map, focus.targets, focus.paths, readNullDisplacement(line, map, named));
  results.nullDisplacement.voxelCount *= repeats.voxels();
  completeTissueTable(map, "");
  const bool isNothing = results.nullDisplacement.voxelCount == 0;
  if (isNothing) line.warning("no voxel is far enough to become null displacement");
  if (!isNothing && !keepsTissues(file))
    line.warning(line.outputNames("outputLabelMap").front() + ": the format does not keep which label is null " +
                 "displacement, so that its tetrahedra will not be held still; expected .nrrd");
  line.message("null displacement: " + std::to_string(results.nullDisplacement.voxelCount) + " voxels, label " +
               std::to_string(results.nullDisplacement.label));
  writeTissueMap(withRepeats(map, repeats), file);
}

void returnEstimate(CommandLine& line, const MeshSizeEstimate& estimate)
{
  line.returnValue("estimatedTriangles", std::to_string(std::llround(estimate.triangles)));
  line.returnValue("estimatedTetrahedra", std::to_string(std::llround(estimate.tetrahedra)));
  line.message("estimate: about " + roundedCount(estimate.triangles) + " triangles and " +
               roundedCount(estimate.tetrahedra) + " tetrahedra");
}

/// Completes the names of the map; returns the labels that have names in the map or in the file.
std::set<Label> nameTissues(CommandLine& line, TissueMap& map)
{
  TissueTable all = map.table;
  std::vector<std::string> warnings;
  const std::string file = line.text("names");
  if (!file.empty()) all.merge(readTissueTable(file));
  completeTissueTable(map, file, &warnings);
  for (const std::string& warning : warnings) line.warning(warning);
  std::set<Label> labels;
  for (const auto& entry : all) labels.insert(entry.first);
  return labels;
}

void run(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  const Focus focus =
    readFocus(line.points("targetPoint"), line.texts("targets"), line.points("pathPoint"), line.texts("path"));
  SurgicalScaleOptions options = readOptions(line);
  TissueMap map = readTissueMap(line.text("labelMap"));
  const std::set<Label> named = nameTissues(line, map);
  const std::string lengthsFile = line.text("tissueLengths");
  if (!lengthsFile.empty()) options.tissues = readTissueLengths(lengthsFile, options.range, map.table);
  checkScaleOptions(options, map.grid, focus.targets, focus.paths);

  Results results;
  warnOfOddities(line, map, focus, options);
  warnOfLargeVoxels(line, focus, options);
  results.tissueCount = presentLabels(map).size();
  const ScaleField scale =
    computeSurgicalScale(map, focus.targets, focus.paths, options, subProgress(progress, 0.2, 0.6));
  const auto extremes = std::minmax_element(scale.lengths.begin(), scale.lengths.end());
  results.shortest = *extremes.first;
  results.longest = *extremes.second;
  report(progress, 0.6, "writing the scale");
  writeScale(scale, line.outputFile("scale"));
  const VoxelRepeats repeats = findRepeats(map, results.shortest);
  if (repeats.times > 1) map = withoutRepeats(map, repeats); // as it will be meshed
  report(progress, 0.7, "null displacement");
  markFarTissue(line, map, focus, named, repeats, results);
  report(progress, 0.8, "estimating the size of the mesh");
  results.estimate = estimateMeshSize(map, scale);
  results.meshing = meshingSize(map, scale);
  results.meshing.tetrahedra = std::max(results.meshing.tetrahedra, results.estimate.tetrahedra);
  results.surfaceMemory = std::max(estimateReadingMemory(repeats.grid), estimateSurfaceMemory(results.meshing));
  results.tetrahedralMemory = estimateTetrahedralMemory(results.meshing);

  line.message("edge lengths: " + text::rounded(results.shortest, 4) + " to " + text::rounded(results.longest, 4) +
               " mm");
  returnEstimate(line, results.estimate);
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty()) writeReport(reportFile, line, focus, options, results, repeats.grid, scale.grid);
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
