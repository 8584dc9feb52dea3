// SPDX-License-Identifier: Apache-2.0
// MultirateSolverCLI: replays recorded tools in a mesh of parent and children; writes forces, displacements and rates.

#include "CommandLine.h"
#include "ConstitutiveTags.h"
#include "Errors.h"
#include "FileSeries.h"
#include "JsonReport.h"
#include "MaterialTable.h"
#include "MultirateSolverCLIXML.h"
#include "Replay.h"
#include "TextFile.h"
#include "VTKFiles.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace surgicalmesher;

namespace
{

constexpr double kMetre = 1e3; ///< mm; a stiffness in N/m divided by it is in N/mm

ReplayOptions readOptions(const CommandLine& line)
{
  ReplayOptions options;
  options.law = line.text("law") == "linear" ? ChildLaw::Linear : ChildLaw::NeoHookean;
  const std::vector<double> weight = line.numbers("weight");
  if (weight.size() != 3) throw UsageError("--weight: expected three numbers, x,y,z in N/m^3");
  for (int i = 0; i < 3; ++i) options.weight[i] = weight[std::size_t(i)] / (kMetre * kMetre * kMetre);
  options.toolRadius = line.number("toolRadius");
  options.reach = line.number("reach");
  options.toolStiffness = line.number("toolStiffness") / kMetre;
  options.childRate = line.number("childRate");
  options.parentRate = line.number("parentRate");
  options.tolerance = line.number("tolerance");
  return options;
}

std::map<Label, TissueMaterial> readMaterials(CommandLine& line, const MeshFile& parent, const MeshFile& child)
{
  const std::string file = line.text("materials");
  if (file.empty()) return {};
  std::set<Label> present(parent.mesh.labels.begin(), parent.mesh.labels.end());
  present.insert(child.mesh.labels.begin(), child.mesh.labels.end());
  TissueTable names = parent.tissues;
  names.insert(child.tissues.begin(), child.tissues.end());
  std::vector<std::string> warnings;
  std::map<Label, TissueMaterial> materials = readMaterialTable(file, names, present, &warnings);
  for (const std::string& warning : warnings) line.warning(warning);
  return materials;
}

/// Throws InputError if parent and child file are interchanged. Files without SubMesh cannot be checked.
void requireParts(const CommandLine& line, const MeshFile& parent, const MeshFile& child)
{
  const auto isChilds = [](std::int32_t subMesh) { return subMesh > 0; };
  if (!parent.subMesh.empty() && std::all_of(parent.subMesh.begin(), parent.subMesh.end(), isChilds))
    throw InputError(line.text("parentMesh") + ": all tetrahedra are a child's (SubMesh), expected the parent's");
  if (!child.subMesh.empty() && std::none_of(child.subMesh.begin(), child.subMesh.end(), isChilds))
    throw InputError(line.text("childMesh") + ": all tetrahedra are the parent's (SubMesh), expected a child's");
}

/// The children's law is one for all their tetrahedra, whatever the table says, or a mesh that has nonlinear tetrahedra
/// beside linear ones.
void warnOfLaw(CommandLine& line, const MeshFile& child, const std::map<Label, TissueMaterial>& materials)
{
  if (line.text("law") == "linear") return;
  const auto& tags = child.constitutive;
  const bool isDivided = std::find(tags.begin(), tags.end(), kNonlinear) != tags.end();
  std::size_t linear = 0;
  for (std::size_t t = 0; t < child.mesh.labels.size(); ++t)
  {
    const auto row = materials.find(child.mesh.labels[t]);
    const bool isLinearTissue = row != materials.end() && row->second.nonlinearLaw == MaterialLaw::LinearElastic;
    const bool isTagged = isDivided && tags[t] == kLinear;
    linear += isLinearTissue || isTagged ? 1 : 0;
  }
  if (linear > 0)
    line.warning(
      std::to_string(linear) + " tetrahedra of " + line.text("childMesh") +
      " are linear by --materials or Constitutive, and neo-Hookean here by --law, which holds for all of them");
}

/// The file of a part, to be written again with displacements.
class DisplacedPart
{
public:
  explicit DisplacedPart(const std::string& file) : m_File(readVTKFile(file, { ".vtu", ".vtk" }))
  {
    m_Grid = vtkUnstructuredGrid::SafeDownCast(m_File.data);
    if (m_File.ras) sayRAS();
    m_Displacement->SetName("Displacement");
    m_Displacement->SetNumberOfComponents(3);
    m_Displacement->SetNumberOfTuples(m_Grid->GetNumberOfPoints());
    m_Grid->GetPointData()->AddArray(m_Displacement);
  }

  /// `displacements`: of the points of the whole mesh, LPS.
  void write(const CoupledMesh& mesh, const std::vector<Vec3>& displacements, const std::string& file)
  {
    vtkDataArray* ids = m_Grid->GetPointData()->GetArray("VolumePointId");
    const double turned = m_File.ras ? -1 : 1;
    for (vtkIdType p = 0; p < m_Grid->GetNumberOfPoints(); ++p)
    {
      const auto& all = mesh.volumePointIds;
      const auto n = std::lower_bound(all.begin(), all.end(), std::int32_t(ids->GetTuple1(p))) - all.begin();
      const Vec3& u = displacements[std::size_t(n)];
      m_Displacement->SetTuple3(p, turned * u.x, turned * u.y, u.z);
    }
    writeGrid(m_Grid, file, FieldTexts::Written);
  }

private:
  /// The title of a legacy file, which may say so, is not written again.
  void sayRAS()
  {
    vtkNew<vtkStringArray> space;
    space->SetName("SPACE");
    space->InsertNextValue("RAS");
    m_Grid->GetFieldData()->AddArray(space);
  }

  VTKFile m_File;
  vtkUnstructuredGrid* m_Grid;
  vtkNew<vtkDoubleArray> m_Displacement;
};

/// The collection of the child's files, one per exchange.
class Motion
{
public:
  explicit Motion(CommandLine& line) : m_Line(line)
  {
    if (line.outputFile("motion").empty()) return;
    m_Name = std::filesystem::path(line.outputNames("motion").front());
    m_Prefix = (m_Name.parent_path() / m_Name.stem()).string() + "_";
    line.alsoWritesMany("motion", m_Prefix, ".vtu");
  }

  void add(double seconds, const CoupledMesh& mesh, const std::vector<Vec3>& displacements, DisplacedPart& child)
  {
    if (m_Name.empty()) return;
    const std::string number = std::to_string(m_Files.size());
    const std::string file = m_Prefix + std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number + ".vtu";
    child.write(mesh, displacements, m_Line.outputPath(file));
    m_Files.push_back({ text::rounded(seconds, 16), std::filesystem::path(file).filename().string() });
  }

  void finish()
  {
    if (!m_Name.empty()) writeFileSeries(m_Files, m_Line.outputFile("motion"));
  }

private:
  CommandLine& m_Line;
  std::filesystem::path m_Name;
  std::string m_Prefix;
  std::vector<SeriesFile> m_Files;
};

void writeForces(const std::vector<ReplayStep>& steps, const std::string& file)
{
  if (file.empty()) return;
  std::string table = "seconds,child,x,y,z,forceX,forceY,forceZ,largestDisplacement,iterations\n";
  for (const ReplayStep& step : steps)
  {
    table += text::rounded(step.seconds, 16) + "," + std::to_string(step.child);
    for (int i = 0; i < 3; ++i) table += "," + text::rounded(step.tip[i], 9);
    for (int i = 0; i < 3; ++i) table += "," + text::rounded(step.force[i], 9);
    table += "," + text::rounded(step.largestDisplacement, 9) + "," + std::to_string(step.iterations) + "\n";
  }
  writeBytes(table, file);
}

/// 0 if there are no values.
double quantile(std::vector<double> values, double share)
{
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::size_t(share * double(values.size() - 1))];
}

void writeSizes(JsonWriter& json, const ReplaySizes& sizes)
{
  writeMember(json, "wholeUnknowns", sizes.wholeUnknowns);
  json.Key("children");
  json.StartArray();
  for (const ReplaySizes::Child& child : sizes.children)
  {
    json.StartObject();
    writeMember(json, "unknowns", child.unknowns);
    writeMember(json, "interfaceUnknowns", child.interfaceUnknowns);
    writeMember(json, "heldUnknowns", child.heldUnknowns);
    writeMember(json, "factorEntries", child.factorEntries);
    json.EndObject();
  }
  json.EndArray();
}

void writeReport(const std::string& file, const CommandLine& line, const ReplayResult& result)
{
  if (file.empty()) return;
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "module", "MultirateSolver");
    writeMember(json, "parentMesh", line.text("parentMesh"));
    writeMember(json, "childMesh", line.text("childMesh"));
    json.Key("parameters");
    json.StartObject();
    writeMember(json, "law", line.text("law"));
    writeMember(json, "weight", line.numbers("weight"));
    for (const char* name : { "toolRadius", "reach", "toolStiffness", "childRate", "parentRate", "tolerance" })
      writeMember(json, name, line.number(name));
    json.EndObject();
    writeSizes(json, result.sizes);
    writeMember(json, "steps", result.steps.size());
    writeMember(json, "preparationSeconds", result.times.preparation);
    writeMember(json, "medianStepSeconds", quantile(result.times.steps, 0.5));
    writeMember(json, "slowestStepSeconds", quantile(result.times.steps, 1));
    writeMember(json, "medianExchangeSeconds", quantile(result.times.exchanges, 0.5));
    writeWarnings(json, line.warnings());
  };
  writeBytes(jsonText(writeMembers), file);
}

void warnOfRate(CommandLine& line, const ReplayResult& result)
{
  const double median = quantile(result.times.steps, 0.5), rate = line.number("childRate");
  if (median * rate > 1)
    line.warning("a step takes " + text::rounded(1e3 * median) + " ms, more than the " + text::rounded(1e3 / rate) +
                 " ms between two at " + text::rounded(rate) + " Hz: a smaller child or --toolRadius keeps up");
}

void run(CommandLine& line)
{
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  const ReplayOptions options = readOptions(line);
  Motion motion(line);
  const MeshFile parent = readMesh(line.text("parentMesh")), child = readMesh(line.text("childMesh"));
  requireParts(line, parent, child);
  std::vector<ToolPath> tools;
  for (const std::string& file : line.texts("tool")) tools.push_back(readToolPath(file));
  const std::map<Label, TissueMaterial> materials = readMaterials(line, parent, child);
  warnOfLaw(line, child, materials);
  const CoupledMesh mesh = coupledMesh(parent, child, materials);
  DisplacedPart displacedChild(line.text("childMesh"));
  const ReplayResult result = replay(
    mesh, tools, options,
    [&](double seconds, const std::vector<Vec3>& displacements)
    { motion.add(seconds, mesh, displacements, displacedChild); },
    subProgress(progress, 0.05, 0.95));

  report(progress, 0.95, "writing");
  motion.finish();
  displacedChild.write(mesh, result.displacements, line.outputFile("displacedChild"));
  const std::string parentFile = line.outputFile("displacedParent");
  if (!parentFile.empty()) DisplacedPart(line.text("parentMesh")).write(mesh, result.displacements, parentFile);
  writeForces(result.steps, line.outputFile("forces"));
  warnOfRate(line, result);
  writeReport(line.outputFile("report"), line, result);
  const double median = 1e3 * quantile(result.times.steps, 0.5);
  line.message(std::to_string(result.steps.size()) + " steps of " + text::rounded(median) + " ms in the median, " +
               std::to_string(mesh.children) + (mesh.children == 1 ? " child" : " children") + ", " +
               std::to_string(mesh.whole.size()) + " unknowns in all");
  line.returnValue("medianStep", text::rounded(median, 6));
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
