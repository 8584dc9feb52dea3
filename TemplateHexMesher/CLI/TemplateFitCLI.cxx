// SPDX-License-Identifier: Apache-2.0
// TemplateFitCLI: fits a template to a target by pairs of landmarks, and reports the quality of the fit.

#include "Carrying.h"
#include "CommandLine.h"
#include "ElementMeshIO.h"
#include "ElementQuality.h"
#include "Errors.h"
#include "Repair.h"
#include "ReportMembers.h"
#include "SolverExports.h"
#include "TemplateFit.h"
#include "TemplateFitCLIXML.h"
#include "Text.h"
#include "TissueMapIO.h"
#include "Validity.h"

#include <vtkPointSet.h>
#include <vtkSMPTools.h>

#include <array>
#include <filesystem>
#include <sstream>

using namespace surgicalmesher;

namespace
{

/// Millimetres in one unit of the files.
struct Units
{
  double ofTemplate, ofTarget;
};

double millimetresIn(const std::string& unit)
{
  if (unit == "m") return 1000;
  return unit == "cm" ? 10 : 1;
}

NamedPoints readLandmarks(const std::string& file, double unit)
{
  NamedPoints landmarks;
  landmarks.file = file;
  std::vector<Vec3> positions;
  for (const Markup& markup : readLabelledMarkups(file))
  {
    landmarks.names.insert(landmarks.names.end(), markup.labels.begin(), markup.labels.end());
    positions.insert(positions.end(), markup.points.begin(), markup.points.end());
  }
  landmarks.points.resize(3, Eigen::Index(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    landmarks.points.col(Eigen::Index(i)) = unit * Eigen::Vector3d(positions[i].x, positions[i].y, positions[i].z);
  return landmarks;
}

/// Returns the landmarks of the template and of the patient.
std::array<NamedPoints, 2> readLandmarks(const CommandLine& line, const Units& units)
{
  const std::vector<std::string> files = line.texts("landmarks");
  if (files.size() != 2)
    throw UsageError("--landmarks: " + std::to_string(files.size()) +
                     " files found, expected the template's and the patient's");
  return { readLandmarks(files[0], units.ofTemplate), readLandmarks(files[1], units.ofTarget) };
}

TriangleSurface readTarget(const CommandLine& line, double unit)
{
  TriangleSurface target = readSurfaceOf(line.text("target"));
  const std::string innerFile = line.text("inner");
  if (!innerFile.empty())
  {
    const TriangleSurface inner = readSurfaceOf(innerFile);
    const auto first = std::int32_t(target.points.cols());
    Points both(3, first + inner.points.cols());
    both << target.points, inner.points;
    target.points = both;
    for (const Triangle& t : inner.triangles) target.triangles.push_back({ t[0] + first, t[1] + first, t[2] + first });
  }
  target.points *= unit;
  return target;
}

/// Reads the material table for the tissues of the template.
void readMaterials(CommandLine& line, SolverExports& exports, const ElementMeshFile& content, const std::string& file)
{
  if (exports.materialFile.empty()) return;
  const SolidMesh solid = solidMeshOf(content, content.mesh.points, file);
  readMaterials(line, exports, solid.tissues, { solid.labels.begin(), solid.labels.end() });
}

/// A mesh that is deformed along with the template, and the file beside the fitted mesh to which it is written.
struct Carried
{
  std::string source, destination;
  ElementMeshFile content;
};

/// Announces the files of the carried meshes. Does not read any file yet.
std::vector<Carried> announceCarried(CommandLine& line)
{
  const std::filesystem::path fitted = line.outputNames("fitted").at(0);
  std::vector<Carried> files;
  for (const std::string& file : line.texts("carry"))
  {
    const std::string name = fitted.stem().string() + "." + std::filesystem::path(file).stem().string() + ".vtu";
    files.push_back({ file, (fitted.parent_path() / name).string(), {} });
    line.alsoWrites("carry", files.back().destination);
  }
  return files;
}

void writeCarried(CommandLine& line, const std::vector<Carried>& files, const Units& units, const Points& from,
                  const Points& to)
{
  for (const Carried& file : files)
  {
    const std::vector<Element>& elements = file.content.mesh.elements;
    const Points moved = repaired({ carried(units.ofTemplate * file.content.mesh.points, from, to), elements });
    const std::size_t invalid = validityOf(elements, moved).invalid;
    if (invalid > 0)
      line.warning(file.destination + ": " + std::to_string(invalid) +
                   " elements are invalid and could not be repaired, " +
                   std::to_string(validityOf(elements, file.content.mesh.points).invalid) + " were before");
    writeElementMesh(file.content, moved / units.ofTarget, file.source, line.outputPath(file.destination));
  }
}

// ---- report ---------------------------------------------------------------------------------------------------------

const char* nameOf(ElementShape shape)
{
  constexpr const char* names[] = { "triangles", "quadrilaterals", "tetrahedra", "wedges", "hexahedra" };
  return names[int(shape)];
}

void writeQuality(JsonWriter& json, const char* key, const ElementMesh& mesh)
{
  json.Key(key);
  json.StartObject();
  const std::vector<ElementQuality> quality = elementQuality(mesh);
  for (const ElementShape shape : { ElementShape::Hexahedron, ElementShape::Wedge, ElementShape::Tetrahedron })
  {
    const QualitySummary summary = summaryOf(mesh, quality, shape);
    if (summary.elements == 0) continue;
    json.Key(nameOf(shape));
    json.StartObject();
    writeQuality(json, summary);
    json.EndObject();
  }
  json.EndObject();
}

/// Distances in both directions, for the spline alone or for the fit.
struct Distances
{
  DistanceSummary toTarget, fromTarget;
};

Distances distancesOf(const ElementMesh& mesh, const Points& points, const TargetSurface& target)
{
  const TriangleSurface surface = compacted(points, trianglesOf(outerFaces(mesh.elements), points));
  return { distanceBetween(surface, target), distanceBetween(target.surface(), TargetSurface(surface)) };
}

void writeDistances(JsonWriter& json, const char* key, const Distances& distances)
{
  json.Key(key);
  json.StartObject();
  writeDistance(json, "fittedToTarget", distances.toTarget);
  writeDistance(json, "targetToFitted", distances.fromTarget);
  json.EndObject();
}

void writeLandmarks(JsonWriter& json, const LandmarkPairs& pairs, const Points& fitted)
{
  json.Key("landmarks");
  json.StartArray();
  for (std::size_t i = 0; i < pairs.names.size(); ++i)
  {
    json.StartObject();
    writeMember(json, "name", pairs.names[i]);
    writeMember(json, "residual", (fitted.col(Eigen::Index(i)) - pairs.target.col(Eigen::Index(i))).norm());
    json.EndObject();
  }
  json.EndArray();
}

struct Report
{
  const ElementMesh& mesh; ///< the template, mm
  const LandmarkPairs& pairs;
  const FitResult& fit;
  Distances ofSpline, ofFit;
};

/// Lengths are in mm, whatever the units of the files.
void writeReport(const std::string& file, const CommandLine& line, const Report& report)
{
  writeReportFile(file,
                  [&](JsonWriter& json)
                  {
                    writeMember(json, "module", "TemplateFit");
                    writeMember(json, "template", line.text("template"));
                    writeMember(json, "target", line.text("target"));
                    writeMember(json, "templateUnit", line.text("templateUnit"));
                    writeMember(json, "targetUnit", line.text("targetUnit"));
                    writeMember(json, "frame", "LPS");
                    writeMember(json, "lengths", "mm");
                    writeMember(json, "alpha", line.number("alpha"));
                    writeMember(json, "iterations", line.integer("iterations"));
                    writeMember(json, "minimumScaledJacobian", line.number("minimumScaledJacobian"));
                    writeMember(json, "repairRounds", report.fit.repairRounds);
                    writeMember(json, "turnedFacets", report.fit.turnedFacets);
                    json.Key("quality");
                    json.StartObject();
                    writeQuality(json, "template", report.mesh);
                    writeQuality(json, "spline", { report.fit.spline, report.mesh.elements });
                    writeQuality(json, "fitted", { report.fit.points, report.mesh.elements });
                    json.EndObject();
                    json.Key("distances");
                    json.StartObject();
                    writeDistances(json, "spline", report.ofSpline);
                    writeDistances(json, "fitted", report.ofFit);
                    json.EndObject();
                    writeLandmarks(json, report.pairs, report.fit.landmarks);
                  });
}

void tell(CommandLine& line, const Report& report)
{
  std::ostringstream text;
  text.precision(3);
  const std::vector<ElementQuality> quality = elementQuality({ report.fit.points, report.mesh.elements });
  for (const ElementShape shape : { ElementShape::Hexahedron, ElementShape::Wedge, ElementShape::Tetrahedron })
  {
    const QualitySummary summary = summaryOf(report.mesh, quality, shape);
    if (summary.elements == 0) continue;
    text << summary.elements << " " << nameOf(shape) << ", " << summary.invalid << " invalid, scaled Jacobian at least "
         << summary.minimum << ", on average " << summary.mean << "; ";
  }
  if (report.fit.turnedFacets > 0)
    text << report.fit.turnedFacets << " facets of the surface are turned over after repair; ";
  text << "fitted to target " << report.ofFit.toTarget.mean << " mm on average, 95 % within "
       << report.ofFit.toTarget.percentile95 << " mm; target to fitted " << report.ofFit.fromTarget.mean << " and "
       << report.ofFit.fromTarget.percentile95 << " mm";
  line.message(text.str());
}

void run(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  SolverExports exports = readExports(line);
  std::vector<Carried> carriedFiles = announceCarried(line);
  const Units units{ millimetresIn(line.text("templateUnit")), millimetresIn(line.text("targetUnit")) };
  const auto landmarks = readLandmarks(line, units);
  const LandmarkPairs pairs = pairedByName(landmarks[0], landmarks[1]);
  requireUsable(pairs, landmarks[0].file, landmarks[1].file);
  const std::string templateFile = line.text("template"), fittedName = line.outputNames("fitted").at(0);
  const ElementMeshFile content = readElementMesh(templateFile);
  requireRightSideOut(content.mesh, templateFile);
  requireWritable(content, templateFile, fittedName);
  readMaterials(line, exports, content, templateFile);
  for (Carried& file : carriedFiles) file.content = readElementMesh(file.source);
  const ElementMesh mesh{ units.ofTemplate * content.mesh.points, content.mesh.elements };
  requireNear(landmarks[0], mesh.points, templateFile);
  const TargetSurface target(readTarget(line, units.ofTarget));
  requireNear(landmarks[1], target.surface().points, line.text("target"));

  FitOptions options;
  options.alpha = line.number("alpha");
  options.iterations = line.integer("iterations");
  options.landmarkWeight = line.number("landmarkWeight");
  options.minimumScaledJacobian = line.number("minimumScaledJacobian");
  const FitResult fit = fitTemplate(mesh, pairs, target, options, subProgress(progress, 0.05, 0.8));
  const double least = validityOf(mesh.elements, fit.points).minimum;
  if (least < options.minimumScaledJacobian)
    line.warning(templateFile + ": the least scaled Jacobian of the fit is " + text::rounded(least) + ", expected " +
                 text::rounded(options.minimumScaledJacobian) + " (--minimumScaledJacobian)");
  report(progress, 0.8, "measuring");
  const Report results{ mesh, pairs, fit, distancesOf(mesh, fit.spline, target),
                        distancesOf(mesh, fit.points, target) };
  report(progress, 0.9, "writing");
  writeElementMesh(content, fit.points / units.ofTarget, templateFile, line.outputFile("fitted"));
  writeCarried(line, carriedFiles, units, mesh.points, fit.points);
  writeExports(line, exports, content, fit.points, templateFile);
  tell(line, results);
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty()) writeReport(reportFile, line, results);
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
