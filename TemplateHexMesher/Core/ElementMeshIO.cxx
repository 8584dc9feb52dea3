// SPDX-License-Identifier: Apache-2.0
#include "ElementMeshIO.h"

#include "Errors.h"
#include "SolverMeshText.h"
#include "TargetSurface.h"
#include "TextFile.h"
#include "VTKFiles.h"

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSignedCharArray.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace surgicalmesher
{
namespace
{

[[noreturn]] void refuse(const std::string& file, const std::string& message)
{
  throw InputError(file + ": " + message);
}

std::string extensionOf(const std::string& file) { return text::extensionOf(file); }

/// Reads .obj files. VTK's reader splits and renumbers the points of files with texture coordinates.
VTKFile readObj(const std::string& file)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  const std::vector<std::string> lines = text::splitLines(text::readTextFile(file));
  for (std::size_t n = 0; n < lines.size(); ++n)
  {
    const std::vector<std::string> words = text::splitWords(lines[n]);
    if (words.empty() || (words[0] != "v" && words[0] != "f")) continue;
    const auto refuseLine = [&](const char* expected)
    { refuse(file + ":" + std::to_string(n + 1), "\"" + lines[n].substr(0, 60) + "\", expected " + expected); };
    double p[3] = { 0, 0, 0 };
    if (words[0] == "v")
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        if (words.size() < 4 || !text::parseNumber(words[i + 1], p[i])) refuseLine("three coordinates");
      }
      points->InsertNextPoint(p);
      continue;
    }
    polygons->InsertNextCell(int(words.size()) - 1);
    for (std::size_t i = 1; i < words.size(); ++i)
    {
      long id = 0;
      const long count = long(points->GetNumberOfPoints());
      if (!text::parseInteger(words[i].substr(0, words[i].find('/')), -count, count, id) || id == 0)
        refuseLine("points that stand before");
      polygons->InsertCellPoint(id > 0 ? id - 1 : count + id);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  return { data.GetPointer(), false };
}

int vtkTypeOf(ElementShape shape)
{
  constexpr int types[] = { VTK_TRIANGLE, VTK_QUAD, VTK_TETRA, VTK_WEDGE, VTK_HEXAHEDRON };
  return types[int(shape)];
}

/// Permutation between VTK's numbering of a cell's points and that of Element; it is its own inverse.
std::array<int, 8> vtkOrder(int type)
{
  if (type == VTK_WEDGE) return { 0, 2, 1, 3, 5, 4, 6, 7 };
  if (type == VTK_VOXEL) return { 0, 1, 3, 2, 4, 5, 7, 6 };
  return { 0, 1, 2, 3, 4, 5, 6, 7 };
}

void addSets(const std::map<std::string, std::vector<std::int32_t>>& sets, vtkIdType count, vtkDataSetAttributes* data)
{
  for (const auto& [name, ids] : sets)
  {
    vtkNew<vtkSignedCharArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfValues(count);
    array->Fill(0);
    for (const std::int32_t id : ids) array->SetValue(id, 1);
    data->AddArray(array);
  }
}

void addIds(const std::vector<std::int64_t>& ids, const char* name, vtkDataSetAttributes* data)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  for (const std::int64_t id : ids) array->InsertNextValue(id);
  data->AddArray(array);
}

vtkSmartPointer<vtkPoints> vtkPointsOf(const Points& points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) result->SetPoint(i, points.col(i).data());
  return result;
}

VTKFile gridOf(const SolverMesh& content)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(vtkPointsOf(content.mesh.points));
  grid->Allocate(vtkIdType(content.mesh.elements.size()));
  for (const Element& element : content.mesh.elements)
  {
    const int type = vtkTypeOf(element.shape);
    const std::array<int, 8> order = vtkOrder(type);
    vtkIdType ids[8];
    for (int i = 0; i < nodeCount(element.shape); ++i) ids[i] = element.nodes[order[i]];
    grid->InsertNextCell(type, nodeCount(element.shape), ids);
  }
  addIds(content.nodeIds, "NodeId", grid->GetPointData());
  addIds(content.elementIds, "ElementId", grid->GetCellData());
  addSets(content.nodeSets, grid->GetNumberOfPoints(), grid->GetPointData());
  addSets(content.elementSets, grid->GetNumberOfCells(), grid->GetCellData());
  return { grid.GetPointer(), false };
}

SolverMesh readAnsys(const std::string& file)
{
  std::filesystem::path nodes = file, elements = file;
  nodes.replace_extension(".node");
  elements.replace_extension(".elem");
  text::requireReadableFile(nodes.string());
  text::requireReadableFile(elements.string());
  return readAnsysMesh(nodes.string(), elements.string());
}

VTKFile readAny(const std::string& file)
{
  const std::string extension = extensionOf(file);
  if (extension == ".inp") return gridOf(readAbaqusMesh(file));
  if (extension == ".node" || extension == ".elem") return gridOf(readAnsys(file));
  if (extension == ".obj") return readObj(file);
  const std::vector<std::string> kindsOfVTK{ ".vtu", ".vtp", ".vtk", ".stl", ".ply" };
  if (std::find(kindsOfVTK.begin(), kindsOfVTK.end(), extension) != kindsOfVTK.end())
    return readVTKFile(file, kindsOfVTK);
  text::requireReadableFile(file);
  refuse(file,
         "unknown kind of file '" + extension + "', expected .vtu, .vtp, .vtk, .stl, .ply, .obj, .inp, .node or .elem");
}

void turnToLps(vtkPointSet* data)
{
  vtkPoints* points = data->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    points->SetPoint(i, -p[0], -p[1], p[2]);
  }
}

Points pointsOf(vtkPointSet* data, const std::string& file)
{
  Points points(3, data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) data->GetPoint(i, points.col(i).data());
  if (!points.allFinite()) refuse(file, "a coordinate that is no finite number, expected numbers");
  return points;
}

std::vector<Element> elementsOf(vtkPointSet* data, const std::string& file)
{
  std::vector<Element> elements;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    vtkNew<vtkIdList> storage;
    data->GetCellPoints(c, storage);
    count = storage->GetNumberOfIds();
    ids = storage->GetPointer(0);
    int type = data->GetCellType(c);
    if (type == VTK_POLYGON && (count == 3 || count == 4)) type = count == 3 ? VTK_TRIANGLE : VTK_QUAD;
    Element element;
    switch (type)
    {
    case VTK_TRIANGLE: element.shape = ElementShape::Triangle; break;
    case VTK_QUAD: element.shape = ElementShape::Quad; break;
    case VTK_TETRA: element.shape = ElementShape::Tetrahedron; break;
    case VTK_WEDGE: element.shape = ElementShape::Wedge; break;
    case VTK_HEXAHEDRON:
    case VTK_VOXEL: element.shape = ElementShape::Hexahedron; break;
    default:
      refuse(file, "cell " + std::to_string(c) + " is of VTK's type " + std::to_string(type) +
                     ", expected triangles, quadrilaterals, tetrahedra, wedges or hexahedra");
    }
    const std::array<int, 8> order = vtkOrder(type);
    for (int i = 0; i < nodeCount(element.shape); ++i)
    {
      const vtkIdType id = ids[order[i]];
      if (id < 0 || id >= data->GetNumberOfPoints())
        refuse(file, "cell " + std::to_string(c) + " refers to a point that is not there");
      element.nodes[i] = std::int32_t(id);
    }
    elements.push_back(element);
  }
  if (elements.empty()) refuse(file, "no element, expected a surface or a mesh");
  return elements;
}

std::size_t countInsideOut(const ElementMesh& mesh, ElementShape shape, std::size_t& all)
{
  std::size_t count = 0;
  all = 0;
  for (const Element& element : mesh.elements)
  {
    if (element.shape != shape) continue;
    ++all;
    if (volumeOf(element, mesh.points) < 0) ++count;
  }
  return count;
}

/// Swaps the numbering of all wedges if most are inside out: not every program follows VTK's documented numbering.
void renumberWedges(ElementMesh& mesh)
{
  std::size_t all = 0;
  if (2 * countInsideOut(mesh, ElementShape::Wedge, all) <= all) return;
  std::size_t hexahedra = 0;
  if (2 * countInsideOut(mesh, ElementShape::Hexahedron, hexahedra) > hexahedra) return;
  for (Element& element : mesh.elements)
  {
    if (element.shape != ElementShape::Wedge) continue;
    std::swap(element.nodes[1], element.nodes[2]);
    std::swap(element.nodes[4], element.nodes[5]);
  }
}

void setSpace(vtkPointSet* data)
{
  vtkNew<vtkStringArray> space;
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  data->GetFieldData()->AddArray(space);
}

void writeText(const std::string& content, const std::string& file)
{
  std::ofstream stream(file.c_str(), std::ios::binary);
  stream << content << std::flush;
  if (!stream) refuse(file, "the mesh cannot be written whole");
}

template <class Writer>
void writeXml(vtkPointSet* data, const std::string& file)
{
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetFileName(file.c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (writer->Write() == 0 || writer->GetErrorCode() != 0) refuse(file, "the mesh cannot be written whole");
}

vtkSmartPointer<vtkUnstructuredGrid> gridOf(vtkPointSet* data)
{
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data)) return grid;
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->Allocate(data->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    data->GetCellPoints(c, ids);
    grid->InsertNextCell(data->GetCellType(c), ids);
  }
  grid->SetPoints(data->GetPoints());
  grid->GetPointData()->ShallowCopy(data->GetPointData());
  grid->GetCellData()->ShallowCopy(data->GetCellData());
  grid->GetFieldData()->ShallowCopy(data->GetFieldData());
  return grid;
}

} // namespace

ElementMeshFile readElementMesh(const std::string& file)
{
  const VTKFile read = readAny(file);
  if (read.data && read.data->GetNumberOfPoints() > 0 && read.ras) turnToLps(read.data);
  return elementMeshOf(read.data, file);
}

ElementMeshFile elementMeshOf(const vtkSmartPointer<vtkPointSet>& data, const std::string& name)
{
  if (!data || data->GetNumberOfPoints() == 0) refuse(name, "no point, expected a surface or a mesh");
  setSpace(data);
  ElementMeshFile content{ { pointsOf(data, name), elementsOf(data, name) }, data };
  renumberWedges(content.mesh);
  return content;
}

TriangleSurface readSurfaceOf(const std::string& file)
{
  const ElementMesh mesh = readElementMesh(file).mesh;
  const std::vector<Triangle> triangles = trianglesOf(outerFaces(mesh.elements), mesh.points);
  TriangleSurface surface = withoutDuplicates(compacted(mesh.points, triangles));
  if (surface.triangles.empty()) refuse(file, "no triangle with an area, expected a surface");
  return surface;
}

void requireRightSideOut(const ElementMesh& mesh, const std::string& file)
{
  for (const auto& [shape, name] :
       { std::pair{ ElementShape::Hexahedron, "hexahedra" }, std::pair{ ElementShape::Wedge, "wedges" },
         std::pair{ ElementShape::Tetrahedron, "tetrahedra" } })
  {
    std::size_t all = 0;
    const std::size_t insideOut = countInsideOut(mesh, shape, all);
    if (10 * insideOut <= all) continue;
    refuse(file, std::to_string(insideOut) + " of " + std::to_string(all) + " " + name +
                   " are inside out, expected their base counter-clockwise seen from the opposite side");
  }
}

void requireWritable(const ElementMeshFile& content, const std::string& templateFile, const std::string& file)
{
  const std::string extension = extensionOf(file), source = extensionOf(templateFile);
  const bool isSurface = vtkPolyData::SafeDownCast(content.data) != nullptr;
  const bool isOwnKind = extension == source && (extension == ".inp" || extension == ".node");
  if (extension == ".vtu" || (extension == ".vtp" && isSurface) || isOwnKind) return;
  throw UsageError(file + ": can't be written from " + templateFile + ", expected .vtu" +
                   (isSurface ? " or .vtp" : "") + (source == ".inp" || source == ".node" ? " or " + source : ""));
}

void writeElementMesh(const ElementMeshFile& content, const Points& points, const std::string& templateFile,
                      const std::string& file)
{
  requireWritable(content, templateFile, file);
  const std::string extension = extensionOf(file);
  if (extension == ".inp") return writeText(abaqusWithPoints(templateFile, points), file);
  if (extension == ".node") return writeText(ansysNodesWithPoints(templateFile, points), file);
  const auto data = vtkSmartPointer<vtkPointSet>::Take(content.data->NewInstance());
  data->ShallowCopy(content.data);
  data->SetPoints(vtkPointsOf(points));
  if (extension == ".vtp") writeXml<vtkXMLPolyDataWriter>(data, file);
  else writeXml<vtkXMLUnstructuredGridWriter>(gridOf(data), file);
}

} // namespace surgicalmesher
