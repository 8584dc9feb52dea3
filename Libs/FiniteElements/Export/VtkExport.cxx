// SPDX-License-Identifier: Apache-2.0
#include "VtkExport.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <set>

namespace surgicalmesher
{
namespace
{

template <class Array>
void named(Array& array, const char* name, vtkFieldData* owner)
{
  array->SetName(name);
  owner->AddArray(array);
}

/// Adds the points of the mesh that shells use, in the order of the mesh; `shellId` receives the index of each mesh
/// point among them.
void addPoints(vtkPolyData* data, const FiniteElementModel& model, std::vector<std::int32_t>& shellId)
{
  const std::vector<Vec3>& meshPoints = model.content.mesh.points;
  shellId.assign(meshPoints.size(), -1);
  for (const Shell& shell : model.shells)
  {
    for (const Cell& cell : shell.cells)
    {
      for (const std::int32_t id : cell) shellId[id] = 0;
    }
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIntArray> volumeId;
  for (std::size_t i = 0; i < shellId.size(); ++i)
  {
    if (shellId[i] < 0) continue;
    shellId[i] = static_cast<std::int32_t>(points->InsertNextPoint(&meshPoints[i].x));
    volumeId->InsertNextValue(static_cast<int>(i));
  }
  data->SetPoints(points);
  named(volumeId, "VolumePointId", data->GetPointData());
}

void addTriangles(vtkPolyData* data, const FiniteElementModel& model, const std::vector<std::int32_t>& shellId)
{
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIntArray> label;
  vtkNew<vtkDoubleArray> thickness;
  for (const Shell& shell : model.shells)
  {
    for (const Cell& cell : shell.cells)
    {
      triangles->InsertNextCell(static_cast<int>(cell.size()));
      for (const std::int32_t id : cell) triangles->InsertCellPoint(shellId[id]);
      label->InsertNextValue(shell.ids[0]);
      thickness->InsertNextValue(shell.thickness);
    }
  }
  data->SetPolys(triangles);
  named(label, "TissueLabel", data->GetCellData());
  named(thickness, "Thickness", data->GetCellData());
}

void addTissues(vtkPolyData* data, const FiniteElementModel& model)
{
  vtkNew<vtkStringArray> space, names;
  vtkNew<vtkIntArray> ids;
  vtkNew<vtkDoubleArray> colors;
  colors->SetNumberOfComponents(3);
  space->InsertNextValue("LPS");
  std::set<std::int32_t> shells;
  for (const Shell& shell : model.shells) shells.insert(shell.ids[0]);
  for (const ElementSet& set : model.elementSets)
  {
    if (set.kind != SetKind::Tissue || shells.count(set.ids[0]) == 0) continue;
    ids->InsertNextValue(set.ids[0]);
    names->InsertNextValue(set.original);
    colors->InsertNextTuple(set.color.data());
  }
  named(space, "SPACE", data->GetFieldData());
  named(ids, "TissueIds", data->GetFieldData());
  named(names, "TissueNames", data->GetFieldData());
  named(colors, "TissueColors", data->GetFieldData());
}

int typeOf(const Cell& element)
{
  if (element.size() == 10) return VTK_QUADRATIC_TETRA;
  return element.size() == 4 ? VTK_TETRA : element.size() == 6 ? VTK_WEDGE : VTK_HEXAHEDRON;
}

/// Adds an array with 1 for each member of a set and 0 for others.
void addMembership(const std::string& name, const std::vector<std::int32_t>& members, std::size_t count,
                   vtkFieldData* data)
{
  vtkNew<vtkIntArray> array;
  array->SetNumberOfValues(static_cast<vtkIdType>(count));
  array->Fill(0);
  for (const std::int32_t id : members) array->SetValue(id, 1);
  named(array, name.c_str(), data);
}

/// Elements of any shape with the arrays of writeMesh() and the sets of kind Named.
vtkSmartPointer<vtkUnstructuredGrid> gridOf(const FiniteElementModel& model)
{
  const MeshFile& content = model.content;
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : content.mesh.points) points->InsertNextPoint(&p.x);
  grid->SetPoints(points);
  vtkNew<vtkIntArray> label, subMesh, constitutive;
  for (std::size_t e = 0; e < model.elements.size(); ++e)
  {
    const Cell cell = inOrderOfVtk(model.elements[e]);
    vtkIdType ids[10];
    std::copy(cell.begin(), cell.end(), ids);
    grid->InsertNextCell(typeOf(cell), static_cast<vtkIdType>(cell.size()), ids);
    label->InsertNextValue(content.mesh.labels[e]);
    subMesh->InsertNextValue(content.subMesh[e]);
    constitutive->InsertNextValue(content.constitutive[e]);
  }
  named(label, "TissueLabel", grid->GetCellData());
  named(subMesh, "SubMesh", grid->GetCellData());
  named(constitutive, "Constitutive", grid->GetCellData());
  vtkNew<vtkDoubleArray> length;
  for (const double value : content.targetEdgeLength) length->InsertNextValue(value);
  if (!content.targetEdgeLength.empty()) named(length, "TargetEdgeLength", grid->GetPointData());
  for (const ElementSet& set : model.elementSets)
  {
    if (set.kind == SetKind::Named) addMembership(set.name, set.elements, model.elements.size(), grid->GetCellData());
  }
  for (const NodeSet& set : model.nodeSets)
  {
    if (set.kind == SetKind::Named)
      addMembership(set.name, set.points, content.mesh.points.size(), grid->GetPointData());
  }
  return grid;
}

} // namespace

void writeVtk(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const bool areCorners = !model.content.mesh.tetrahedra.empty() && model.elements[0].size() == 4;
  const bool areNamed = std::any_of(model.nodeSets.begin(), model.nodeSets.end(),
                                    [](const NodeSet& set) { return set.kind == SetKind::Named; });
  if (!areCorners || areNamed) return writeGrid(gridOf(model), destination(file), FieldTexts::LeftOut);
  writeMesh(model.content, destination(file), FieldTexts::LeftOut);
}

void writeShells(const FiniteElementModel& model, const std::string& file)
{
  vtkNew<vtkPolyData> data;
  std::vector<std::int32_t> shellId;
  addPoints(data, model, shellId);
  addTriangles(data, model, shellId);
  addTissues(data, model);
  writePolyData(data, file);
}

} // namespace surgicalmesher
