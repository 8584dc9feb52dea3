// SPDX-License-Identifier: Apache-2.0
// FuchsTetrahedralizerCLI reads a multi-tissue surface (and its ambient tetrahedra) and writes labelled tetrahedra and
// their quality.

#include "AmbientMatch.h"
#include "CommandLine.h"
#include "CurveFiles.h"
#include "CurvedSides.h"
#include "Errors.h"
#include "Export.h"
#include "FuchsTetrahedralizerCLIXML.h"
#include "MaterialTable.h"
#include "NodeChoices.h"
#include "Parallel.h"
#include "Report.h"
#include "SecondOrder.h"
#include "ShellChoices.h"
#include "SubMeshExport.h"
#include "SurfaceEdgeLength.h"
#include "SurfacePreparation.h"
#include "SurfaceRefused.h"
#include "Tetrahedralizer.h"
#include "TextFile.h"
#include "TissueMapIO.h"
#include "Units.h"
#include "VtkExport.h"
#include "Warnings.h"

#include <vtkSMPTools.h>

#include <filesystem>
#include <functional>
#include <set>

using namespace surgicalmesher;

namespace
{

TargetLengths readLengths(const CommandLine& line, const SurfaceFile& content)
{
  const std::string scaleFile = line.text("scale");
  const double uniform = line.number("edgeLength");
  if (uniform > 0) return lengthsOf([uniform](const Vec3&) { return uniform; });
  if (!scaleFile.empty())
  {
    const ScaleField scale = readScale(scaleFile);
    requireCover(scale, content.surface.points, scaleFile);
    return lengthsOf(scale);
  }
  if (content.targetEdgeLength.empty())
  {
    throw UsageError("neither --scale nor --edgeLength is given, and " + line.text("surface") +
                     " has no point array TargetEdgeLength, expected one of them");
  }
  return lengthsOf(edgeLengthFromPoints(content.surface.points, content.targetEdgeLength));
}

/// Returns the surface and, if given, its background tetrahedra.
TetrahedralizerInput readInput(CommandLine& line, SurfaceFile&& content, const std::function<MeshFile()>& readAmbient,
                               const SizingFunction& edgeLength)
{
  TetrahedralizerInput input;
  input.name = line.text("surface");
  input.tissues = std::move(content.tissues);
  if (!readAmbient)
  {
    FillableSurface prepared = fillableSurface(content.surface, edgeLength, input.name);
    input.surface = std::move(prepared.surface);
    if (prepared.soleLabel)
    {
      line.message(input.name + " is the surface of tissue " + std::to_string(*prepared.soleLabel) +
                   " alone: its neighbours become outside");
    }
    return input;
  }
  input.surface = std::move(content.surface);
  input.background = readAmbient();
  if (!isInterfaceOf(input.surface, input.background->mesh))
  {
    throw InputError(line.text("ambient") + ": these tetrahedra are of another surface than " + input.name +
                     ", expected the two files that one run has written");
  }
  return input;
}

/// Writes the triangles at fault to the file given for them, or beside the mesh output, and reports the refusal.
[[noreturn]] void refuseWithTriangles(CommandLine& line, const SurfaceRefused& refusal)
{
  const std::filesystem::path folder = std::filesystem::path(line.outputFile("mesh")).parent_path();
  const std::string stem = std::filesystem::path(line.text("surface")).stem().string();
  const std::string besideMesh = (folder / (stem + ".offending.vtp")).string();
  const std::string named = line.outputFile("offendingTriangles");
  SurfaceFile content;
  content.surface = refusal.offending();
  try
  {
    writeSurface(content, named.empty() ? besideMesh : named);
    line.commitOutput("offendingTriangles");
  }
  catch (const Error&)
  {
    throw InputError(refusal.what());
  }
  if (!named.empty()) throw InputError(refusal.what());
  throw InputError(std::string(refusal.what()) + "; these triangles are in " + besideMesh);
}

ConstitutiveRule readConstitutiveRule(const CommandLine& line)
{
  ConstitutiveRule rule{ readFocus(line.points("targetPoint"), line.texts("targets"), line.points("pathPoint"),
                                   line.texts("path")) };
  rule.nonlinearDistance = line.number("nonlinearDistance");
  rule.nonlinearDistanceAtTarget = line.number("nonlinearDistanceAtTarget");
  rule.nullTargetRadius = line.number("nullDisplacementRadius");
  rule.nullPathDistance = line.number("nullDisplacementPathDistance");
  rule.nullPathDistanceAtTarget = line.number("nullDisplacementPathDistanceAtTarget");
  checkConstitutiveRule(rule);
  return rule;
}

/// Without --shell, returns the tissues that were meshed as shells in the surface stage.
std::vector<ShellChoice> readShells(const CommandLine& line, const TissueTable& names, const std::set<Label>& present)
{
  std::vector<ShellChoice> choices = shellChoices(line.texts("shell"), names, present, line.number("shellThickness"));
  if (choices.empty() && line.given("shells"))
    throw UsageError("--shells is given, but no --shell, and no tissue of the surface has the role of a shell");
  return choices;
}

CurveNetwork readCurveNetwork(const CommandLine& line, const SizingFunction& edgeLength)
{
  std::vector<Curve> curves;
  for (const std::string& file : line.texts("curves"))
    for (Curve& curve : readCurves(file, line.number("curveRadius"))) curves.push_back(std::move(curve));
  return curveNetwork(curves, edgeLength);
}

/// Checks what the command line alone determines.
void requireUsableOptions(CommandLine& line)
{
  if (line.given("scale") && line.number("edgeLength") > 0)
    throw UsageError("--scale and --edgeLength are both given, expected one of them");
  if (line.flag("conditioning") && !line.given("report"))
    throw UsageError("--conditioning is given, but no --report, expected both");
  if (line.given("curveMesh") && line.texts("curves").empty())
    throw UsageError("--curveMesh is given, but no --curves, expected both");
  if (line.integer("elementOrder") == 2 && !line.texts("curves").empty())
    throw UsageError(
      "--elementOrder 2 is given, and --curves, whose beams and trusses have two nodes; expected one of them");
  if (line.flag("curvedSides") && line.integer("elementOrder") != 2)
    throw UsageError("--curvedSides is given, but not --elementOrder 2, expected both");
  for (const std::string& file : line.outputNames("export"))
  {
    requireOrder(file, line.integer("elementOrder"));
    for (const ExportSidecar& sidecar : exportSidecars(file, !line.texts("curves").empty()))
    {
      if (sidecar.isMany) line.alsoWritesMany("export", sidecar.before, sidecar.after);
      else line.alsoWrites("export", sidecar.before);
    }
  }
  const bool chosen = !line.texts("shell").empty();
  if (chosen && !line.given("shells") && !line.given("export"))
    throw UsageError("--shell is given, but neither --shells nor --export");
  if (!nodeChoices(line.texts("nodeSet")).empty() && !line.given("export"))
    throw UsageError("--nodeSet is given, but no --export, expected both");
  if (!line.texts("nodeMarkups").empty() && !line.given("export"))
    throw UsageError("--nodeMarkups is given, but no --export, expected both");
}

FiniteElementOptions readFiniteElementOptions(CommandLine& line, const TetrahedralizerInput& content)
{
  std::set<Label> present;
  for (const auto& sides : content.surface.labels) present.insert(sides.begin(), sides.end());
  present.erase(0);
  FiniteElementOptions options;
  const std::string materials = line.text("materials");
  std::vector<std::string> warnings;
  if (!materials.empty()) options.materials = readMaterialTable(materials, content.tissues, present, &warnings);
  for (const std::string& warning : warnings) line.warning(warning);
  options.shells = readShells(line, content.tissues, present);
  options.nodes = nodeChoices(line.texts("nodeSet"), line.texts("nodeMarkups"));
  options.beams.areTrusses = line.text("curveElements") == "truss";
  options.beams.material.youngsModulus = 1e-3 * line.number("curveYoungsModulus");
  return options;
}

void writeExports(CommandLine& line, const MeshFile& content, const FiniteElementOptions& options)
{
  const std::vector<std::string> files = line.outputNames("export");
  const std::string shells = line.outputFile("shells");
  if (files.empty() && shells.empty()) return;
  FiniteElementModel model = finiteElementModel(content, options);
  if (!shells.empty()) writeShells(model, shells);
  if (line.integer("elementOrder") == 2) model = withMidSideNodes(std::move(model));
  if (line.flag("curvedSides")) model = withCurvedSides(std::move(model));
  model = inUnits(std::move(model), unitsNamed(line.text("units")));
  for (const std::string& file : files)
  {
    exportModel(model, file, [&](const std::string& finalPath) { return line.outputPath(finalPath); });
  }
}

void writeChildAndParent(CommandLine& line, const MeshFile& whole)
{
  const std::string parentFile = line.outputFile("parentMesh"), childFile = line.outputFile("childMesh");
  if (!parentFile.empty()) writeMesh(partOf(whole, [](std::int32_t subMesh) { return subMesh == 0; }), parentFile);
  if (childFile.empty()) return;
  const MeshFile children = partOf(whole, [](std::int32_t subMesh) { return subMesh > 0; });
  if (children.mesh.tetrahedra.empty())
  {
    throw InputError(line.text("surface") + ": the mesh has no child, as its edge length is the same everywhere; "
                                            "expected lengths with a finer region for --childMesh");
  }
  writeMesh(children, childFile);
}

void returnFigures(CommandLine& line, const QualityGroup& whole)
{
  line.returnValue("tetrahedronCount", std::to_string(whole.tetrahedra));
  line.returnValue("pointCount", std::to_string(whole.points));
  line.returnValue("smallestDihedralAngle", std::to_string(whole.dihedral.minimum));
}

VertexPlacement readPlacement(const CommandLine& line)
{
  const std::string name = line.text("placement");
  if (name == "not whole") return VertexPlacement::NotWhole;
  return name == "all" ? VertexPlacement::All : VertexPlacement::Lattice;
}

void warnUnlessEmpty(CommandLine& line, const std::string& warning)
{
  if (!warning.empty()) line.warning(warning);
}

void mesh(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  requireUsableOptions(line);
  TetrahedralizerOptions options;
  options.constitutive = readConstitutiveRule(line);
  options.placement = readPlacement(line);
  std::function<MeshFile()> readAmbient; // reads in parallel to the surface; the reading ends if that is refused
  if (const std::string ambient = line.text("ambient"); !ambient.empty()) readAmbient = beginReadingMesh(ambient);
  SurfaceFile content = readSurface(line.text("surface"));
  const bool isOfMap = !content.boundaryDistance.empty(); // folded at cracks of the map, which are no edges to preserve
  options.featureAngle = isOfMap ? 0 : line.number("featureAngle");
  const TargetLengths lengths = readLengths(line, content);
  warnUnlessEmpty(line, warningOfLengths(content, lengths.inWorld));
  options.curves = readCurveNetwork(line, lengths.inWorld);
  TetrahedralizerInput input = readInput(line, std::move(content), readAmbient, lengths.inWorld);
  for (const std::string& warning : warningsOfPlaces(options.constitutive, input.surface)) line.warning(warning);
  const FiniteElementOptions model = readFiniteElementOptions(line, input);

  const bool fromBackground = input.background.has_value();
  const FiniteElementMesh result =
    tetrahedralizeTissues(std::move(input), lengths, options, subProgress(progress, 0.1, 0.95));

  warnUnlessEmpty(line, warningOfStillness(result.content.constitutive));
  MeshQuality quality;
  std::map<Label, ExplicitStep> steps;
  std::map<Label, Betti> topology;
  const std::string reportFile = line.outputFile("report");
  runInParallel({ [&] { writeMesh(result.content, line.outputFile("mesh")); },
                  [&] { quality = assessQuality(result.content.mesh, result.content.subMesh, lengths.inWorld); },
                  [&] { steps = explicitSteps(result.content, model.materials); },
                  [&]
                  {
                    if (!reportFile.empty()) topology = meshTopology(result.content.mesh);
                  } });
  writeChildAndParent(line, result.content);
  if (const std::string curves = line.outputFile("curveMesh"); !curves.empty()) writeCurves(result.content, curves);
  writeExports(line, result.content, model);
  MeshReport figures{ result, quality, steps, topology, {}, fromBackground, line.warnings() };
  if (line.flag("conditioning")) figures.conditioning = stiffnessConditioning(result.content.mesh);
  if (!reportFile.empty()) writeBytes(reportJson(figures), reportFile);
  line.message(summaryOf(figures));
  returnFigures(line, quality.whole);
  report(progress, 1, "done");
}

void run(CommandLine& line)
{
  try
  {
    mesh(line);
    line.discardOutput("offendingTriangles");
  }
  catch (const SurfaceRefused& refusal)
  {
    refuseWithTriangles(line, refusal);
  }
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
