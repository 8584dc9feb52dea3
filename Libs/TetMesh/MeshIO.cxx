// SPDX-License-Identifier: Apache-2.0
#include "MeshIO.h"

#include "Compaction.h"
#include "Errors.h"
#include "TextFile.h"
#include "VTKErrors.h"
#include "VTKFiles.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <set>

namespace surgicalmesher
{
namespace
{

constexpr const char* kSpace = "SPACE";
constexpr const char* kBoundaryLabels = "BoundaryLabels";
constexpr const char* kTissueLabel = "TissueLabel";
constexpr const char* kSubMesh = "SubMesh";
constexpr const char* kConstitutive = "Constitutive";
constexpr const char* kInterface = "Interface";
constexpr const char* kInterfaceId = "InterfaceId";
constexpr const char* kVolumePointId = "VolumePointId";
constexpr const char* kTargetEdgeLength = "TargetEdgeLength";
constexpr const char* kRadius = "Radius";
constexpr const char* kBoundaryDistance = "BoundaryDistance";
constexpr const char* kTissueIds = "TissueIds";
constexpr const char* kTargetAngle = "TargetDihedralAngle";
constexpr const char* kTissueNames = "TissueNames";
constexpr const char* kTissueColors = "TissueColors";
constexpr const char* kTissueRoles = "TissueRoles";
constexpr const char* kShell = "shell"; // a value of TissueRoles, like the next
constexpr const char* kNullDisplacement = "null displacement";

[[noreturn]] void refuse(const std::string& file, const std::string& what) { throw InputError(file + ": " + what); }

// ---- reading: VTK objects out of files ------------------------------------------------------------------------------

vtkSmartPointer<vtkPolyData> trianglesOf(vtkPointSet* data, const std::string& file)
{
  if (!vtkPolyData::SafeDownCast(data)) refuse(file, "holds an unstructured grid, expected polygonal data");
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(data);
  filter->PassLinesOff();
  filter->PassVertsOff();
  ErrorCatcher quiet;
  filter->Update();
  if (filter->GetOutput()->GetNumberOfPolys() == 0) refuse(file, "no triangles, expected a triangulated surface");
  return filter->GetOutput();
}

// ---- reading: plain arrays out of VTK objects -----------------------------------------------------------------------

std::vector<Vec3> pointsOf(vtkPointSet* data, bool ras, const std::string& file)
{
  std::vector<Vec3> points(data->GetNumberOfPoints());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    Vec3& p = points[i];
    data->GetPoint(i, &p.x);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
    {
      refuse(file, "point " + std::to_string(i) + " has a coordinate that isn't a finite number");
    }
    if (ras) p = { 0 - p.x, 0 - p.y, p.z }; // not -p.x, which turns 0 into -0
  }
  return points;
}

/// The named array with one tuple of `components` per item, or nullptr if there is none.
vtkDataArray* arrayOf(vtkFieldData* data, const char* name, vtkIdType items, int components, const std::string& file)
{
  if (!data->GetAbstractArray(name)) return nullptr;
  vtkDataArray* array = data->GetArray(name);
  const std::string expected = std::to_string(components) + " numbers for each of " + std::to_string(items);
  if (!array) refuse(file, std::string("array ") + name + " is not numeric, expected " + expected);
  if (array->GetNumberOfTuples() != items || array->GetNumberOfComponents() != components)
  {
    refuse(file, std::string("array ") + name + " has " + std::to_string(array->GetNumberOfComponents()) +
                   " components and " + std::to_string(array->GetNumberOfTuples()) + " tuples, expected " + expected);
  }
  return array;
}

/// Component c of tuple i as an integer in [lowest, highest].
std::int32_t integerAt(vtkDataArray* array, vtkIdType i, int c, int lowest, int highest, const std::string& file)
{
  const double value = array->GetComponent(i, c);
  if (!(value >= lowest && value <= highest) || value != std::floor(value))
  {
    refuse(file, std::string("array ") + array->GetName() + " has the value " + std::to_string(value) + " at " +
                   std::to_string(i) + ", expected an integer from " + std::to_string(lowest) + " to " +
                   std::to_string(highest));
  }
  return static_cast<std::int32_t>(value);
}

std::vector<double> numbersOf(vtkFieldData* data, const char* name, vtkIdType items, double lowest,
                              const std::string& file)
{
  vtkDataArray* array = arrayOf(data, name, items, 1, file);
  if (!array) return {};
  std::vector<double> numbers(items);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    numbers[i] = array->GetComponent(i, 0);
    if (!std::isfinite(numbers[i]) || !(numbers[i] > lowest))
    {
      refuse(file, std::string("array ") + name + " has the value " + std::to_string(numbers[i]) + " at " +
                     std::to_string(i) + ", expected a finite number" + (lowest == 0 ? " over 0" : ""));
    }
  }
  return numbers;
}

std::vector<std::int32_t> integersOf(vtkFieldData* data, const char* name, vtkIdType items, int highest,
                                     const std::string& file, int lowest = 0)
{
  vtkDataArray* array = arrayOf(data, name, items, 1, file);
  if (!array) return {};
  std::vector<std::int32_t> integers(items);
  for (std::size_t i = 0; i < integers.size(); ++i)
  {
    integers[i] = integerAt(array, i, 0, lowest, highest, file);
  }
  return integers;
}

constexpr double kAnyNumber = -std::numeric_limits<double>::infinity();
constexpr int kHighestLabel = std::numeric_limits<Label>::max();
constexpr int kHighestInteger = std::numeric_limits<std::int32_t>::max();

void requireIdRange(vtkIdType count, const char* what, const std::string& file)
{
  if (count > kHighestInteger)
  {
    refuse(file, std::to_string(count) + " " + what + ", at most " + std::to_string(kHighestInteger) + " are handled");
  }
}

// ---- writing --------------------------------------------------------------------------------------------------------

vtkSmartPointer<vtkPoints> vtkPointsOf(const std::vector<Vec3>& points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result->SetPoint(i, &points[i].x);
  return result;
}

template <std::size_t N>
vtkSmartPointer<vtkCellArray> vtkCellsOf(const std::vector<std::array<std::int32_t, N>>& cells)
{
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->AllocateExact(cells.size(), N * cells.size());
  for (const auto& cell : cells)
  {
    std::array<vtkIdType, N> ids;
    std::copy(cell.begin(), cell.end(), ids.begin());
    result->InsertNextCell(N, ids.data());
  }
  return result;
}

template <class Array, class Value>
void addArray(vtkFieldData* data, const char* name, const std::vector<Value>& values, int components = 1)
{
  if (values.empty()) return;
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(values.size() / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data->AddArray(array);
}

void addStrings(vtkFieldData* data, const char* name, const std::vector<std::string>& values)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& value : values) array->InsertNextValue(value);
  data->AddArray(array);
}

/// Returns 0 if there is no meaningful angle.
double targetAngleOf(vtkFieldData* data)
{
  vtkDataArray* angle = data->GetArray(kTargetAngle);
  if (!angle || angle->GetNumberOfTuples() != 1 || angle->GetNumberOfComponents() != 1) return 0;
  const double degrees = angle->GetTuple1(0);
  return degrees > 0 && degrees < 60 ? degrees : 0;
}

void removeStrings(vtkFieldData* data)
{
  for (const char* name : { kSpace, kTissueNames, kTissueRoles }) data->RemoveArray(name);
}

/// Composes the file in memory, because VTK's writers do not detect every failure of the disk.
template <class Writer>
void writeXML(Writer* writer, vtkDataSet* data, const std::string& file)
{
  ErrorCatcher errors;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (!writer->Write() || errors.any()) refuse(file, "can't be composed (" + errors.message() + ")");
  writeBytes(writer->GetOutputString(), file);
}

void writeLegacy(vtkUnstructuredGrid* grid, const std::string& file, FieldTexts texts)
{
  ErrorCatcher errors;
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetHeader("SurgicalMesher tetrahedra; SPACE=LPS");
  // ASCII for readers that do not swap bytes; see FieldTexts.
  if (texts == FieldTexts::LeftOut) writer->SetFileTypeToASCII();
  else writer->SetFileTypeToBinary();
  writer->SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2); // understood by solvers and older readers
  writer->WriteToOutputStringOn();
  if (!writer->Write() || errors.any()) refuse(file, "can't be composed (" + errors.message() + ")");
  writeBytes(writer->GetOutputStdString(), file);
}

std::vector<std::array<std::int32_t, 4>> tetrahedraOf(vtkUnstructuredGrid* grid, const std::string& file)
{
  if (grid->GetNumberOfCells() == 0) refuse(file, "no cells, expected tetrahedra");
  std::vector<std::array<std::int32_t, 4>> tetrahedra(grid->GetNumberOfCells());
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    vtkIdType size;
    const vtkIdType* ids;
    grid->GetCells()->GetCellAtId(i, size, ids);
    if (grid->GetCellType(i) != VTK_TETRA || size != 4)
    {
      refuse(file, "cell " + std::to_string(i) + " is of VTK type " + std::to_string(grid->GetCellType(i)) +
                     ", expected tetrahedra alone");
    }
    std::copy(ids, ids + 4, tetrahedra[i].begin());
  }
  return tetrahedra;
}

void requirePositive(const TetMesh& mesh, const std::string& file)
{
  std::vector<bool> used(mesh.points.size(), false);
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i)
  {
    const auto& t = mesh.tetrahedra[i];
    for (const std::int32_t id : t) used[id] = true;
    if (!(orient(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]) > 0))
    {
      refuse(file, "tetrahedron " + std::to_string(i) + " is flat or inverted, expected positive volumes");
    }
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end())
  {
    refuse(file, "point " + std::to_string(unused - used.begin()) + " belongs to no tetrahedron");
  }
}

} // namespace

SurfaceFile readSurface(const std::string& file)
{
  const VTKFile source = readVTKFile(file, { ".vtp", ".vtk", ".stl", ".ply", ".obj" });
  const vtkSmartPointer<vtkPolyData> data = trianglesOf(source.data, file);
  requireIdRange(data->GetNumberOfPoints(), "points", file);
  requireIdRange(data->GetNumberOfCells(), "triangles", file);

  SurfaceFile result;
  SurfaceComplex& surface = result.surface;
  surface.triangles.resize(data->GetNumberOfPolys());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    vtkIdType size;
    const vtkIdType* ids;
    data->GetPolys()->GetCellAtId(i, size, ids);
    std::copy(ids, ids + 3, surface.triangles[i].begin());
    if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0])
    {
      refuse(file, "triangle " + std::to_string(i) + " uses a point twice");
    }
  }
  const vtkIdType triangleCount = data->GetNumberOfPolys();
  if (vtkDataArray* labels = arrayOf(data->GetCellData(), kBoundaryLabels, triangleCount, 2, file))
  {
    surface.labels.resize(surface.triangles.size());
    for (std::size_t i = 0; i < surface.labels.size(); ++i)
    {
      for (int side = 0; side < 2; ++side)
      {
        surface.labels[i][side] = static_cast<Label>(integerAt(labels, i, side, 0, kHighestLabel, file));
      }
      if (surface.labels[i][0] == surface.labels[i][1])
      {
        refuse(file, "triangle " + std::to_string(i) + " has label " + std::to_string(surface.labels[i][0]) +
                       " on both sides");
      }
    }
  }
  const vtkIdType pointCount = data->GetNumberOfPoints();
  surface.points = pointsOf(data, source.ras, file);
  result.targetEdgeLength = numbersOf(data->GetPointData(), kTargetEdgeLength, pointCount, 0, file);
  result.boundaryDistance = numbersOf(data->GetPointData(), kBoundaryDistance, pointCount, kAnyNumber, file);
  result.tissues = tissuesOf(source.data->GetFieldData());
  const std::vector<std::int32_t> kept = compactPoints(surface.triangles, surface.points.size());
  surface.points = valuesAt(surface.points, kept);
  result.targetEdgeLength = valuesAt(result.targetEdgeLength, kept);
  result.boundaryDistance = valuesAt(result.boundaryDistance, kept);
  return result;
}

void writePolyData(vtkPolyData* data, const std::string& file)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writeXML(writer.Get(), data, file);
}

void writeSurface(const SurfaceFile& content, const std::string& file)
{
  if (text::extensionOf(file) != ".vtp") refuse(file, "surfaces are written as .vtp");
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtkPointsOf(content.surface.points));
  data->SetPolys(vtkCellsOf(content.surface.triangles));
  std::vector<int> labels;
  std::set<Label> present;
  for (const auto& pair : content.surface.labels)
  {
    labels.insert(labels.end(), pair.begin(), pair.end());
    present.insert(pair.begin(), pair.end());
  }
  addArray<vtkIntArray>(data->GetCellData(), kBoundaryLabels, labels, 2);
  addArray<vtkDoubleArray>(data->GetPointData(), kTargetEdgeLength, content.targetEdgeLength);
  addArray<vtkDoubleArray>(data->GetPointData(), kBoundaryDistance, content.boundaryDistance);
  addTissues(data->GetFieldData(), present, content.tissues);
  writePolyData(data, file);
}

std::vector<Polyline> readPolylines(const std::string& file)
{
  const VTKFile source = readVTKFile(file, { ".vtp", ".vtk" });
  vtkPolyData* data = vtkPolyData::SafeDownCast(source.data);
  if (!data) refuse(file, "holds an unstructured grid, expected polygonal data");
  vtkCellArray* lines = data->GetLines();
  if (lines->GetNumberOfCells() == 0) refuse(file, "no lines, expected polylines");
  const std::vector<Vec3> points = pointsOf(source.data, source.ras, file);
  const std::vector<double> radii = numbersOf(data->GetPointData(), kRadius, points.size(), 0, file);
  std::vector<Polyline> result(lines->GetNumberOfCells());
  for (std::size_t n = 0; n < result.size(); ++n)
  {
    vtkIdType size;
    const vtkIdType* ids;
    lines->GetCellAtId(n, size, ids);
    for (vtkIdType k = 0; k < size; ++k)
    {
      result[n].points.push_back(points[ids[k]]);
      if (!radii.empty()) result[n].radii.push_back(radii[ids[k]]);
    }
  }
  return result;
}

void writePolygons(const PolygonFile& content, const std::string& file)
{
  if (text::extensionOf(file) != ".vtp") refuse(file, "polygons are written as .vtp");
  vtkNew<vtkCellArray> cells;
  for (const auto& polygon : content.polygons)
  {
    const std::vector<vtkIdType> ids(polygon.begin(), polygon.end());
    cells->InsertNextCell(vtkIdType(ids.size()), ids.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtkPointsOf(content.points));
  data->SetPolys(cells);
  addArray<vtkIntArray>(data->GetCellData(), kTissueLabel,
                        std::vector<int>(content.labels.begin(), content.labels.end()));
  addTissues(data->GetFieldData(), std::set<Label>(content.labels.begin(), content.labels.end()), content.tissues);
  writePolyData(data, file);
}

MeshFile readMesh(const std::string& file) { return beginReadingMesh(file)(); }

std::function<MeshFile()> beginReadingMesh(const std::string& file)
{
  return [file, end = beginReadingVTKFile(file, { ".vtu", ".vtk" })]
  {
    const VTKFile source = end();
    auto* grid = vtkUnstructuredGrid::SafeDownCast(source.data);
    if (!grid) refuse(file, "holds polygonal data, expected an unstructured grid");
    return meshOfGrid(grid, source.ras, file);
  };
}

MeshFile meshOfGrid(vtkUnstructuredGrid* grid, bool ras, const std::string& name)
{
  const vtkIdType pointCount = grid->GetNumberOfPoints();
  const vtkIdType cellCount = grid->GetNumberOfCells();
  requireIdRange(pointCount, "points", name);
  requireIdRange(cellCount, "cells", name);

  MeshFile result;
  requireValidCells(grid, name);
  result.mesh.tetrahedra = tetrahedraOf(grid, name);
  result.mesh.points = pointsOf(grid, ras, name);
  vtkCellData* cellData = grid->GetCellData();
  const std::vector<std::int32_t> labels = integersOf(cellData, kTissueLabel, cellCount, kHighestLabel, name);
  if (labels.empty()) refuse(name, std::string("no cell array ") + kTissueLabel);
  result.mesh.labels.assign(labels.begin(), labels.end());
  result.subMesh = integersOf(cellData, kSubMesh, cellCount, kHighestInteger, name);
  result.constitutive = integersOf(cellData, kConstitutive, cellCount, 2, name);
  result.subMeshInterface = integersOf(grid->GetPointData(), kInterface, pointCount, 1, name);
  result.targetEdgeLength = numbersOf(grid->GetPointData(), kTargetEdgeLength, pointCount, 0, name);
  result.volumePointId = integersOf(grid->GetPointData(), kVolumePointId, pointCount, kHighestInteger, name);
  result.interfaceId = integersOf(grid->GetPointData(), kInterfaceId, pointCount, kHighestInteger, name, -1);
  result.tissues = tissuesOf(grid->GetFieldData());
  result.targetAngle = targetAngleOf(grid->GetFieldData());
  requirePositive(result.mesh, name);
  return result;
}

void addTissues(vtkFieldData* data, const std::set<Label>& present, const TissueTable& tissues)
{
  addStrings(data, kSpace, { "LPS" });
  std::vector<int> ids;
  std::vector<std::string> names, roles;
  std::vector<double> colors;
  for (const Label label : present)
  {
    if (label == 0) continue;
    const auto found = tissues.find(label);
    const Tissue tissue = found == tissues.end() ? Tissue() : found->second;
    ids.push_back(label);
    names.push_back(tissue.name.empty() ? "tissue " + std::to_string(label) : tissue.name);
    colors.insert(colors.end(), tissue.color.begin(), tissue.color.end());
    roles.push_back(tissue.isShell ? kShell : tissue.isNullDisplacement ? kNullDisplacement : "mesh");
  }
  if (ids.empty()) return;
  addArray<vtkIntArray>(data, kTissueIds, ids);
  addStrings(data, kTissueNames, names);
  addArray<vtkDoubleArray>(data, kTissueColors, colors, 3);
  const bool hasRoles = std::any_of(roles.begin(), roles.end(), [](const std::string& role) { return role != "mesh"; });
  if (hasRoles) addStrings(data, kTissueRoles, roles);
}

TissueTable tissuesOf(vtkFieldData* data)
{
  TissueTable table;
  vtkDataArray* ids = data->GetArray(kTissueIds);
  auto* names = vtkStringArray::SafeDownCast(data->GetAbstractArray(kTissueNames));
  vtkDataArray* colors = data->GetArray(kTissueColors);
  auto* roles = vtkStringArray::SafeDownCast(data->GetAbstractArray(kTissueRoles));
  for (vtkIdType i = 0; ids && i < ids->GetNumberOfTuples(); ++i)
  {
    const double id = ids->GetComponent(i, 0);
    if (!(id >= 0 && id <= kHighestLabel)) continue;
    Tissue& tissue = table[static_cast<Label>(id)];
    if (names && i < names->GetNumberOfValues()) tissue.name = names->GetValue(i);
    const std::string role = roles && i < roles->GetNumberOfValues() ? roles->GetValue(i) : std::string();
    tissue.isShell = role == kShell;
    tissue.isNullDisplacement = role == kNullDisplacement;
    if (colors && colors->GetNumberOfComponents() == 3 && i < colors->GetNumberOfTuples())
    {
      colors->GetTuple(i, tissue.color.data());
    }
  }
  return table;
}

void writeMesh(const MeshFile& content, const std::string& file, FieldTexts texts)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(vtkPointsOf(content.mesh.points));
  grid->SetCells(VTK_TETRA, vtkCellsOf(content.mesh.tetrahedra));
  addArray<vtkIntArray>(grid->GetCellData(), kTissueLabel, content.mesh.labels);
  addArray<vtkIntArray>(grid->GetCellData(), kSubMesh, content.subMesh);
  addArray<vtkIntArray>(grid->GetCellData(), kConstitutive, content.constitutive);
  addArray<vtkIntArray>(grid->GetPointData(), kInterface, content.subMeshInterface);
  addArray<vtkDoubleArray>(grid->GetPointData(), kTargetEdgeLength, content.targetEdgeLength);
  addArray<vtkIntArray>(grid->GetPointData(), kVolumePointId, content.volumePointId);
  addArray<vtkIntArray>(grid->GetPointData(), kInterfaceId, content.interfaceId);
  const std::set<Label> present(content.mesh.labels.begin(), content.mesh.labels.end());
  addTissues(grid->GetFieldData(), present, content.tissues);
  if (content.targetAngle > 0)
    addArray<vtkDoubleArray>(grid->GetFieldData(), kTargetAngle, std::vector<double>{ content.targetAngle });
  writeGrid(grid, file, texts);
}

void writeGrid(vtkUnstructuredGrid* grid, const std::string& file, FieldTexts texts)
{
  if (texts == FieldTexts::LeftOut) removeStrings(grid->GetFieldData());
  const std::string extension = text::extensionOf(file);
  if (extension == ".vtk")
  {
    if (texts == FieldTexts::LeftOut) grid->GetFieldData()->Initialize();
    writeLegacy(grid, file, texts);
    return;
  }
  if (extension != ".vtu") refuse(file, "volume elements are written as .vtu or .vtk");
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writeXML(writer.Get(), grid, file);
}

void writeCurves(const MeshFile& content, const std::string& file)
{
  if (text::extensionOf(file) != ".vtp") refuse(file, "curves are written as .vtp");
  std::map<std::int32_t, double> radiusOf; // at branch points the largest
  for (const CurveChain& curve : content.curves)
    for (std::size_t k = 0; k < curve.points.size(); ++k)
      radiusOf[curve.points[k]] = std::max(radiusOf[curve.points[k]], curve.radii[k]);
  std::map<std::int32_t, vtkIdType> number;
  std::vector<Vec3> points;
  std::vector<int> volumeId, curveId;
  std::vector<double> radii;
  for (const auto& [id, radius] : radiusOf)
  {
    number[id] = vtkIdType(points.size());
    points.push_back(content.mesh.points[id]);
    volumeId.push_back(id);
    radii.push_back(radius);
  }
  vtkNew<vtkCellArray> lines;
  std::vector<std::string> names;
  for (const CurveChain& curve : content.curves)
  {
    curveId.push_back(int(names.size()));
    names.push_back(curve.name);
    lines->InsertNextCell(int(curve.points.size()));
    for (const std::int32_t id : curve.points) lines->InsertCellPoint(number[id]);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtkPointsOf(points));
  data->SetLines(lines);
  addArray<vtkIntArray>(data->GetPointData(), kVolumePointId, volumeId);
  addArray<vtkDoubleArray>(data->GetPointData(), kRadius, radii);
  addArray<vtkIntArray>(data->GetCellData(), "CurveId", curveId);
  addStrings(data->GetFieldData(), "CurveNames", names);
  addStrings(data->GetFieldData(), "SPACE", { "LPS" });
  writePolyData(data, file);
}

} // namespace surgicalmesher
