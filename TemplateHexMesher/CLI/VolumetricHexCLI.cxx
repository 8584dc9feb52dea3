// SPDX-License-Identifier: Apache-2.0
// VolumetricHexCLI: fills a closed surface with known sides by layers of hexahedra, and reports their quality.

#include "CommandLine.h"
#include "ElementMeshIO.h"
#include "ElementQuality.h"
#include "Errors.h"
#include "MeshIO.h"
#include "PartOverlap.h"
#include "ReportMembers.h"
#include "SolverExports.h"
#include "VolumetricHexCLIXML.h"
#include "VolumetricHexahedra.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkSignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>
#include <set>
#include <sstream>

using namespace surgicalmesher;

namespace
{

HexOptions readOptions(const CommandLine& line)
{
  HexOptions options;
  const std::vector<double> divisions = line.numbers("divisions");
  if (divisions.size() != 3)
    throw UsageError("--divisions: " + std::to_string(divisions.size()) + " numbers found, expected three");
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!(divisions[axis] >= 1 && divisions[axis] <= 1000))
      throw UsageError("--divisions: a number out of range, expected 1 to 1000");
    options.divisions[axis] = int(divisions[axis]);
  }
  options.layers = line.integer("layers");
  options.outermost = line.number("outermost");
  if (options.divisions[1] < options.layers)
    throw UsageError("--divisions: " + std::to_string(options.divisions[1]) +
                     " through the tissue, expected at least " + std::to_string(options.layers) + ", the --layers");
  return options;
}

/// The triangles of a file with their sides.
struct Painted
{
  TriangleSurface surface;
  std::vector<Side> sides;
};

Painted readPainted(const std::string& file)
{
  const ElementMeshFile content = readElementMesh(file);
  vtkDataArray* array = content.data->GetCellData()->GetArray("Side");
  if (!array || array->GetNumberOfComponents() != 1)
    throw InputError(file + ": no cell array Side, expected one with 1 outer, 2 inner, 3 right, 4 left, 5 bottom, "
                            "6 top, 0 walls of holes");
  Painted painted;
  painted.surface.points = content.mesh.points;
  for (std::size_t e = 0; e < content.mesh.elements.size(); ++e)
  {
    const Element& element = content.mesh.elements[e];
    if (isVolume(element)) continue;
    const double side = array->GetComponent(vtkIdType(e), 0);
    if (!(side >= 0 && side < kSides && side == int(side)))
      throw InputError(file + ": Side of cell " + std::to_string(e) + " is none of 0 to 6");
    for (const Triangle& t : trianglesOf(outerFaces({ element }), content.mesh.points))
    {
      painted.surface.triangles.push_back(t);
      painted.sides.push_back(Side(int(side)));
    }
  }
  if (painted.sides.empty()) throw InputError(file + ": no triangle, expected a surface");
  return painted;
}

constexpr Label kFiller = 1; ///< the n-th part has the label n + 1

std::vector<Part> readParts(const CommandLine& line)
{
  std::vector<Part> parts;
  std::set<std::string> names{ "filler" };
  for (const std::string& file : line.texts("parts"))
  {
    const std::string name = std::filesystem::path(file).stem().string();
    if (!names.insert(name).second)
      throw UsageError("--parts: two parts would be named " + name + ", expected files of different names");
    parts.push_back({ name, file, readSurfaceOf(file) });
  }
  return parts;
}

std::vector<double> readCutOffs(const CommandLine& line)
{
  const std::size_t parts = line.texts("parts").size();
  std::vector<double> cutOffs = line.numbers("cutOff");
  for (const double cutOff : cutOffs)
  {
    if (!(cutOff >= 0 && cutOff < 1)) throw UsageError("--cutOff: a number out of range, expected at least 0, below 1");
  }
  if (cutOffs.size() == 1) cutOffs.resize(parts, cutOffs[0]);
  if (cutOffs.size() == parts) return cutOffs;
  throw UsageError("--cutOff: " + std::to_string(cutOffs.size()) + " numbers found, expected one, or one for each of " +
                   std::to_string(parts) + " --parts");
}

TissueTable tissuesOf(const std::vector<Part>& parts)
{
  TissueTable tissues{ { kFiller, { "filler" } } };
  for (std::size_t p = 0; p < parts.size(); ++p) tissues[Label(kFiller + p + 1)].name = parts[p].name;
  return tissues;
}

std::set<Label> labelsOf(const TissueTable& tissues)
{
  std::set<Label> labels;
  for (const auto& [label, tissue] : tissues) labels.insert(label);
  return labels;
}

void addLabels(const TissueTable& tissues, const std::vector<std::int32_t>& part, vtkUnstructuredGrid* grid)
{
  vtkNew<vtkIntArray> labels;
  labels->SetName("TissueLabel");
  std::set<Label> present;
  for (const std::int32_t p : part)
  {
    labels->InsertNextValue(kFiller + p);
    present.insert(Label(kFiller + p));
  }
  grid->GetCellData()->AddArray(labels);
  addTissues(grid->GetFieldData(), present, tissues);
}

ElementMeshFile contentOf(const LayeredMesh& mesh)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->Allocate(vtkIdType(mesh.mesh.elements.size()));
  vtkNew<vtkIntArray> layer;
  layer->SetName("Layer");
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
  {
    vtkIdType ids[8];
    std::copy_n(mesh.mesh.elements[e].nodes.begin(), 8, ids);
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
    layer->InsertNextValue(mesh.cells[e][1]);
  }
  grid->GetCellData()->AddArray(layer);
  constexpr Side ends[3][2] = { { Side::Right, Side::Left },
                                { Side::Outer, Side::Inner },
                                { Side::Bottom, Side::Top } };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int end = 0; end < 2; ++end)
    {
      vtkNew<vtkSignedCharArray> set;
      set->SetName(nameOf(ends[axis][end]));
      for (const auto& node : mesh.nodes) set->InsertNextValue(node[axis] == end * mesh.divisions[axis] ? 1 : 0);
      grid->GetPointData()->AddArray(set);
    }
  }
  return { mesh.mesh, grid.GetPointer() };
}

/// Distances between the outer surface of the mesh and that of the envelope, in both directions.
struct Distances
{
  DistanceSummary toEnvelope, fromEnvelope;
};

Distances skinDistances(const LayeredMesh& mesh, const SlabParameterisation& slab)
{
  std::vector<Face> faces;
  for (const Face& face : outerFaces(mesh.mesh.elements))
  {
    bool outside = true;
    for (int i = 0; i < face.size; ++i) outside = outside && mesh.nodes[std::size_t(face.nodes[i])][1] == 0;
    if (outside) faces.push_back(face);
  }
  const TriangleSurface skin = compacted(mesh.mesh.points, trianglesOf(faces, mesh.mesh.points));
  return { distanceBetween(skin, TargetSurface(slab.outer.surface)),
           distanceBetween(slab.outer.surface, TargetSurface(skin)) };
}

void writeParts(JsonWriter& json, const std::vector<Part>& parts, const Classification& classes)
{
  json.Key("parts");
  json.StartArray();
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    const PartMatch& match = classes.matches[p];
    json.StartObject();
    writeMember(json, "name", parts[p].name);
    writeMember(json, "elements", match.elements);
    writeMember(json, "cutOff", match.cutOff);
    writeMember(json, "partVolume", match.partVolume);
    writeMember(json, "elementVolume", match.elementVolume);
    writeMember(json, "recall", match.recall);
    writeMember(json, "precision", match.precision);
    json.EndObject();
  }
  json.EndArray();
}

void tell(CommandLine& line, const QualitySummary& quality, const Distances& distances)
{
  std::ostringstream text;
  text.precision(3);
  text << quality.elements << " hexahedra, " << quality.invalid << " invalid, scaled Jacobian at least "
       << quality.minimum << ", on average " << quality.mean << ", skew " << quality.meanShapeSkew << "; mesh to skin "
       << distances.toEnvelope.mean << " mm on average, skin to mesh " << distances.fromEnvelope.mean << " mm";
  line.message(text.str());
}

void warnOfEmptyParts(CommandLine& line, const std::vector<Part>& parts, const Classification& classes)
{
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    if (classes.matches[p].elements == 0)
      line.warning(parts[p].file + ": no element is this part's; smaller elements, or a lower --cutOff, may have some");
  }
}

void run(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  SolverExports exports = readExports(line);
  const HexOptions options = readOptions(line);
  const std::string envelopeFile = line.text("envelope"), sidesFile = line.text("sides");
  const std::vector<double> cutOffs = readCutOffs(line);
  const std::vector<Part> parts = readParts(line);
  const TissueTable tissues = tissuesOf(parts);
  readMaterials(line, exports, tissues, labelsOf(tissues));
  const Painted painted = readPainted(sidesFile);
  const Envelope envelope = withSides(readSurfaceOf(envelopeFile), painted.surface, painted.sides, sidesFile);
  const SlabParameterisation slab =
    parameterise(envelope, line.number("edgeLength"), envelopeFile, subProgress(progress, 0.05, 0.5));
  const LayeredMesh mesh = layeredHexahedra(slab, options, subProgress(progress, 0.5, 0.85));
  report(progress, 0.85, "classifying");
  const Classification classes = classified(mesh.mesh, parts, cutOffs);
  report(progress, 0.9, "measuring");
  const QualitySummary quality = summaryOf(mesh.mesh, elementQuality(mesh.mesh), ElementShape::Hexahedron);
  const Distances distances = skinDistances(mesh, slab);
  report(progress, 0.95, "writing");
  const ElementMeshFile content = contentOf(mesh);
  addLabels(tissues, classes.part, vtkUnstructuredGrid::SafeDownCast(content.data));
  writeElementMesh(content, mesh.mesh.points, envelopeFile, line.outputFile("mesh"));
  writeExports(line, exports, content, mesh.mesh.points, envelopeFile);
  tell(line, quality, distances);
  warnOfEmptyParts(line, parts, classes);
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty())
  {
    writeReportFile(reportFile,
                    [&](JsonWriter& json)
                    {
                      writeMember(json, "module", "VolumetricHex");
                      writeMember(json, "envelope", envelopeFile);
                      writeQuality(json, quality);
                      writeDistance(json, "meshToSkin", distances.toEnvelope);
                      writeDistance(json, "skinToMesh", distances.fromEnvelope);
                      writeParts(json, parts, classes);
                    });
  }
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
