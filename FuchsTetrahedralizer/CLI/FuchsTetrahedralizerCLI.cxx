// SPDX-License-Identifier: Apache-2.0
// FuchsTetrahedralizerCLI: multi-tissue surface (and its ambient tetrahedra) in; labelled tetrahedra, their quality
// out.

#include "AmbientMatch.h"
#include "AvailableMemory.h"
#include "CommandLine.h"
#include "ConstitutiveTags.h"
#include "EdgeDivision.h"
#include "Errors.h"
#include "Export.h"
#include "FaceAdjacency.h"
#include "FuchsTetrahedralizerCLIXML.h"
#include "InputChecks.h"
#include "InteriorRefill.h"
#include "JsonMember.h"
#include "MaterialTable.h"
#include "MeshChecks.h"
#include "MeshIO.h"
#include "MeshQuality.h"
#include "PrintableText.h"
#include "ShellChoices.h"
#include "StiffnessConditioning.h"
#include "SubMeshExport.h"
#include "SubMeshes.h"
#include "SurfaceEdgeLength.h"
#include "SurfaceTetrahedralization.h"
#include "SurfaceValidity.h"
#include "TetrahedraImprovement.h"
#include "TissueMapIO.h"
#include "TissueSurfaces.h"
#include "VtkExport.h"

#include <rapidjson/document.h>
#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>
#include <vtkSMPTools.h>

#include <filesystem>
#include <optional>
#include <set>
#include <sstream>

using namespace surgicalmesher;

namespace
{

using JsonWriter = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

/// L(x), mm. A scale volume also gives the frame to improve the mesh in: its own, in which copies of all inputs that
/// lie elsewhere in the world have the same numbers.
struct Lengths
{
  SizingFunction inWorld;
  SizingFunction inFrame; ///< the same as inWorld without a frame
  std::optional<Grid> frame;
};

Lengths readLengths(const CommandLine& line, const SurfaceFile& content)
{
  const std::string scaleFile = line.text("scale");
  const double uniform = line.number("edgeLength");
  if (!scaleFile.empty() && uniform > 0)
    throw UsageError("--scale and --edgeLength are both given, expected one of them");
  const auto anywhere = [](const SizingFunction& edgeLength) { return Lengths{ edgeLength, edgeLength, {} }; };
  if (uniform > 0) return anywhere([uniform](const Vec3&) { return uniform; });
  if (!scaleFile.empty())
  {
    const ScaleField scale = readScale(scaleFile);
    requireCover(scale, content.surface.points, scaleFile);
    return { scale, inFrameOf(scale.grid, scale), scale.grid };
  }
  if (content.targetEdgeLength.empty())
  {
    throw UsageError("neither --scale nor --edgeLength is given, and " + line.text("surface") +
                     " has no point array TargetEdgeLength, expected one of them");
  }
  return anywhere(edgeLengthFromPoints(content.surface.points, content.targetEdgeLength));
}

/// Makes the surface ready for the start that was chosen; it has labels then.
void prepareSurface(CommandLine& line, const SizingFunction& edgeLength, SurfaceFile& content)
{
  SurfaceComplex& surface = content.surface;
  const std::string name = line.text("surface");
  const bool labelled = !surface.labels.empty();
  if (!line.text("ambient").empty())
  {
    if (labelled) return;
    throw InputError(name + ": no BoundaryLabels, expected them in a surface with ambient tetrahedra");
  }
  if (!labelled) requireMillimetres(surface, edgeLength, name);
  surface = labelled ? withoutDuplicatePoints(surface) : closedShellsToTissues(surface, name);
  if (const std::optional<Label> sole = leaveNeighboursOut(surface))
    line.message(name + " is the surface of tissue " + std::to_string(*sole) + " alone: its neighbours become outside");
  if (labelled) requireFillable(surface, name);
  requireMemoryFor(estimateTetrahedra(surface, edgeLength), availableMemory(), name);
  surface = withDividedEdges(surface, edgeLength);
}

/// A refusal's triangles go to the file that is named for them, or else beside the mesh that was to be.
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

/// Tetrahedra to begin with, and what the surface stage has improved them to.
struct Start
{
  TetMesh mesh;
  TetrahedraImprovementOptions improvement;
};

Start startOf(const CommandLine& line, const SurfaceComplex& surface, const SizingFunction& edgeLength)
{
  const std::string surfaceName = line.text("surface"), ambientName = line.text("ambient");
  Start start;
  if (ambientName.empty())
  {
    start.mesh = fillWithTetrahedra(surface, edgeLength, surfaceName);
    start.improvement.featureAngle = line.number("featureAngle");
    return start;
  }
  MeshFile ambient = readMesh(ambientName);
  requireInterfacesAre(surface, surfaceName, ambient.mesh, ambientName);
  start.mesh = withLatticeInside(ambient.mesh, edgeLength, surfaceName);
  start.improvement.isImproved = true;
  if (ambient.targetAngle > 0) start.improvement.targetAngle = ambient.targetAngle;
  return start;
}

TetMesh improved(Start start, const Lengths& lengths, const Progress& progress)
{
  TetMesh& ambient = start.mesh;
  const std::optional<Grid>& frame = lengths.frame;
  for (Vec3& p : ambient.points) p = frame ? inFrameOf(*frame, p) : p;
  improveTetrahedra(
    ambient, [&](const Vec3& p) { return double(float(lengths.inFrame(p))); }, start.improvement, progress);
  for (Vec3& p : ambient.points) p = frame ? frame->gridToWorld(p) : p;
  return std::move(ambient);
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

/// Without --shell, the tissues that the surface stage was asked to mesh as shells.
std::vector<ShellChoice> readShells(const CommandLine& line, const TissueTable& names, const std::set<Label>& present)
{
  std::vector<ShellChoice> choices = shellChoices(line.texts("shell"), names, present, line.number("shellThickness"));
  if (choices.empty() && line.given("shells"))
    throw UsageError("--shells is given, but no --shell, and no tissue of the surface has the role of a shell");
  return choices;
}

/// What the command line alone can tell.
void requireUsableOptions(CommandLine& line)
{
  if (line.flag("conditioning") && !line.given("report"))
    throw UsageError("--conditioning is given, but no --report, expected both");
  for (const std::string& file : line.outputNames("export"))
  {
    for (const ExportSidecar& sidecar : exportSidecars(file))
    {
      if (sidecar.isMany) line.alsoWritesMany("export", sidecar.before, sidecar.after);
      else line.alsoWrites("export", sidecar.before);
    }
  }
  const bool chosen = !line.texts("shell").empty();
  if (chosen && !line.given("shells") && !line.given("export"))
    throw UsageError("--shell is given, but neither --shells nor --export");
}

FiniteElementOptions readFiniteElementOptions(CommandLine& line, const SurfaceFile& content)
{
  std::set<Label> present;
  for (const auto& sides : content.surface.labels) present.insert(sides.begin(), sides.end());
  present.erase(0);
  FiniteElementOptions options;
  const std::string materials = line.text("materials");
  if (!materials.empty()) options.materials = readMaterialTable(materials, content.tissues, present);
  const std::string missing =
    materials.empty() ? std::string() : warningOfMaterials(options, present, content.tissues, materials);
  if (!missing.empty()) line.warning(missing);
  options.shells = readShells(line, content.tissues, present);
  return options;
}

void writeExports(CommandLine& line, const MeshFile& content, const FiniteElementOptions& options)
{
  const std::vector<std::string> files = line.outputNames("export");
  const std::string shells = line.outputFile("shells");
  if (files.empty() && shells.empty()) return;
  const FiniteElementModel model = finiteElementModel(content, options);
  if (!shells.empty()) writeShells(model, shells);
  for (const std::string& file : files)
  {
    exportModel(model, file, [&](const std::string& finalPath) { return line.outputPath(finalPath); });
  }
}

MeshFile assemble(const TetMesh& ambient, const SizingFunction& edgeLength, const TissueTable& tissues,
                  const ConstitutiveRule& rule, SubMeshes& division)
{
  MeshFile result;
  result.mesh = withoutOutside(ambient);
  result.tissues = tissues;
  division = divideIntoSubMeshes(result.mesh, edgeLength);
  result.subMesh = division.ofTetrahedron;
  result.constitutive = constitutiveModels(result.mesh, result.subMesh, tissues);
  tagByDistance(result.mesh, rule, result.constitutive);
  result.subMeshInterface.assign(result.mesh.points.size(), 0);
  for (const std::int32_t id : division.interfacePoints) result.subMeshInterface[id] = 1;
  for (const Vec3& p : result.mesh.points) result.targetEdgeLength.push_back(edgeLength(p));
  return result;
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

void writeSubMeshes(JsonWriter& json, const SubMeshes& division)
{
  json.Key("subMeshes");
  json.StartObject();
  writeMember(json, "children", division.children);
  writeMember(json, "pieces", division.pieces);
  writeMember(json, "interfacePoints", division.interfacePoints);
  json.EndObject();
}

void writeTopology(JsonWriter& json, const TetMesh& mesh)
{
  writeObjects(json, "topology", meshTopology(mesh),
               [&](const auto& tissue)
               {
                 const auto& [label, betti] = tissue;
                 writeMember(json, "label", label);
                 writeMember(json, "components", betti.components);
                 writeMember(json, "tunnels", betti.tunnels);
                 writeMember(json, "cavities", betti.cavities);
               });
}

rapidjson::Value stiffnessJSON(const StiffnessConditioning& conditioning, rapidjson::Document::AllocatorType& allocator)
{
  rapidjson::Value stiffness(rapidjson::kObjectType);
  stiffness.AddMember("unknowns", rapidjson::Value(std::uint64_t(conditioning.unknowns)), allocator);
  stiffness.AddMember("converged", rapidjson::Value(conditioning.converged), allocator);
  stiffness.AddMember("conditionNumber", rapidjson::Value(conditioning.condition), allocator);
  stiffness.AddMember("iterations", rapidjson::Value(conditioning.iterations), allocator);
  return stiffness;
}

std::string reportOf(const MeshFile& content, const SubMeshes& division, const MeshQuality& quality, bool fromAmbient,
                     bool withConditioning, const std::vector<std::string>& warnings)
{
  rapidjson::StringBuffer buffer;
  JsonWriter json(buffer);
  json.StartObject();
  writeMember(json, "start", fromAmbient ? "ambient tetrahedra" : "constrained Delaunay");
  writeSubMeshes(json, division);
  writeTopology(json, content.mesh);
  json.Key("quality");
  rapidjson::Document members;
  members.Parse(qualityJSON(quality, content.tissues).c_str());
  if (withConditioning)
  {
    auto& allocator = members.GetAllocator();
    members.AddMember("stiffness", stiffnessJSON(stiffnessConditioning(content.mesh), allocator), allocator);
  }
  members.Accept(json);
  json.Key("warnings");
  json.StartArray();
  for (const std::string& warning : warnings) json.String(printable(warning).c_str());
  json.EndArray();
  json.EndObject();
  return std::string(buffer.GetString()) + "\n";
}

std::string summaryOf(const QualityGroup& whole)
{
  std::ostringstream text;
  text.precision(4);
  text << whole.tetrahedra << " tetrahedra, " << whole.points << " points, dihedral angles " << whole.dihedral.minimum
       << " to " << whole.dihedral.maximum << " degrees, " << 100 * whole.edgesNearTarget
       << " % of edges within 0.7 to 1.4 of their target";
  return text.str();
}

void returnFigures(CommandLine& line, const QualityGroup& whole)
{
  line.returnValue("tetrahedronCount", std::to_string(whole.tetrahedra));
  line.returnValue("pointCount", std::to_string(whole.points));
  line.returnValue("smallestDihedralAngle", std::to_string(whole.dihedral.minimum));
}

void mesh(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  requireUsableOptions(line);
  const ConstitutiveRule rule = readConstitutiveRule(line);
  SurfaceFile content = readSurface(line.text("surface"));
  const Lengths lengths = readLengths(line, content);
  const SizingFunction& edgeLength = lengths.inWorld;
  report(progress, 0.1, "tetrahedra");
  prepareSurface(line, edgeLength, content);
  for (const std::string& warning : warningsOfPlaces(rule, content.surface)) line.warning(warning);
  const FiniteElementOptions options = readFiniteElementOptions(line, content);
  const TetMesh ambient =
    improved(startOf(line, content.surface, edgeLength), lengths, subProgress(progress, 0.3, 0.8));
  report(progress, 0.8, "sub-meshes");
  SubMeshes division;
  const MeshFile result = assemble(ambient, edgeLength, content.tissues, rule, division);
  const std::string stillness = warningOfStillness(result.constitutive);
  if (!stillness.empty()) line.warning(stillness);
  report(progress, 0.9, "checks");
  requireSound(result.mesh, "final check");
  writeMesh(result, line.outputFile("mesh"));
  writeChildAndParent(line, result);
  writeExports(line, result, options);
  const MeshQuality quality = assessQuality(result.mesh, result.subMesh, edgeLength);
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty())
  {
    const bool fromAmbient = !line.text("ambient").empty();
    writeBytes(reportOf(result, division, quality, fromAmbient, line.flag("conditioning"), line.warnings()),
               reportFile);
  }
  line.message(summaryOf(quality.whole));
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
