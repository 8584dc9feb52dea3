// SPDX-License-Identifier: Apache-2.0
#include "ModelMesh.h"

#include "Errors.h"
#include "UnionFind.h"

#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkGeneralTransform.h>
#include <vtkIntArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkReverseSense.h>
#include <vtkStringArray.h>
#include <vtkTriangleFilter.h>
#include <vtkUnstructuredGrid.h>

#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace surgicalmesher
{
namespace
{

// ---- to world -------------------------------------------------------------------------------------------------------

vtkSmartPointer<vtkGeneralTransform> toWorld(vtkMRMLTransformableNode* node)
{
  auto transform = vtkSmartPointer<vtkGeneralTransform>::New();
  vtkMRMLTransformNode::GetTransformBetweenNodes(node->GetParentTransformNode(), nullptr, transform);
  return transform;
}

/// Moves the points of a shallow copy, which shares its arrays with the original. Returns true if the transform
/// mirrors.
bool movePoints(vtkPointSet* mesh, vtkGeneralTransform* transform)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh->GetNumberOfPoints());
  double at[3], derivative[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    mesh->GetPoint(i, at);
    transform->TransformPoint(at, at);
    points->SetPoint(i, at);
  }
  if (points->GetNumberOfPoints() > 0)
  {
    double moved[3];
    transform->Update();
    transform->InternalTransformDerivative(mesh->GetPoint(0), moved, derivative);
  }
  mesh->SetPoints(points);
  return vtkMath::Determinant3x3(derivative) < 0;
}

vtkSmartPointer<vtkPolyData> polyDataInWorld(vtkMRMLModelNode* model)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(model->GetPolyData());
  if (!model->GetParentTransformNode() || !movePoints(surface, toWorld(model))) return surface;
  vtkNew<vtkReverseSense> reverse; // restores what is behind the triangles' normals
  reverse->SetInputData(surface);
  reverse->ReverseCellsOn();
  reverse->Update();
  return reverse->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> gridInWorld(vtkMRMLModelNode* model, vtkMRMLTransformableNode* placed)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->ShallowCopy(model->GetUnstructuredGrid());
  if (!placed->GetParentTransformNode() || !movePoints(grid, toWorld(placed))) return grid;
  vtkNew<vtkCellArray> cells; // restores the positive orientation
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> ids;
    grid->GetCellPoints(i, ids);
    if (ids->GetNumberOfIds() == 4)
    {
      const vtkIdType third = ids->GetId(2);
      ids->SetId(2, ids->GetId(3));
      ids->SetId(3, third);
    }
    cells->InsertNextCell(ids);
  }
  grid->SetCells(VTK_TETRA, cells);
  return grid;
}

// ---- closed surfaces ------------------------------------------------------------------------------------------------

vtkSmartPointer<vtkPolyData> trianglesOf(vtkPolyData* surface)
{
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(surface);
  filter->PassLinesOff();
  filter->PassVertsOff();
  filter->Update();
  return filter->GetOutput();
}

/// Returns the number of shells, triangles joined through edges, as the command-line module counts them.
std::size_t countShells(vtkPolyData* triangles)
{
  vtkNew<vtkCleanPolyData> merge;
  merge->SetInputData(triangles);
  merge->Update();
  vtkPolyData* surface = merge->GetOutput();
  UnionFind shells(surface->GetNumberOfPolys());
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> triangleAt;
  for (vtkIdType t = 0; t < surface->GetNumberOfPolys(); ++t)
  {
    vtkIdType size;
    const vtkIdType* ids;
    surface->GetPolys()->GetCellAtId(t, size, ids);
    for (vtkIdType i = 0; i < size; ++i)
    {
      const std::pair<vtkIdType, vtkIdType> edge = std::minmax(ids[i], ids[(i + 1) % size]);
      shells.unite(triangleAt.try_emplace(edge, t).first->second, t);
    }
  }
  std::set<std::uint32_t> representatives;
  for (vtkIdType t = 0; t < surface->GetNumberOfPolys(); ++t) representatives.insert(shells.find(t));
  return representatives.size();
}

void setTissues(vtkFieldData* data, const std::vector<Tissue>& tissues)
{
  vtkNew<vtkIntArray> ids;
  vtkNew<vtkStringArray> names;
  vtkNew<vtkDoubleArray> colors;
  ids->SetName("TissueIds");
  names->SetName("TissueNames");
  colors->SetName("TissueColors");
  colors->SetNumberOfComponents(3);
  for (const Tissue& tissue : tissues)
  {
    ids->InsertNextValue(ids->GetNumberOfValues() + 1);
    names->InsertNextValue(tissue.name);
    colors->InsertNextTuple(tissue.color.data());
  }
  data->AddArray(ids);
  data->AddArray(names);
  data->AddArray(colors);
}

vtkSmartPointer<vtkPolyData> closedSurfacesInWorld(const std::vector<vtkMRMLModelNode*>& models)
{
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  std::vector<Tissue> tissues;
  for (vtkMRMLModelNode* model : models)
  {
    const vtkSmartPointer<vtkPolyData> triangles = trianglesOf(polyDataInWorld(model));
    append->AddInputData(triangles);
    Tissue tissue;
    if (model->GetDisplayNode()) model->GetDisplayNode()->GetColor(tissue.color.data());
    const std::size_t shells = countShells(triangles);
    for (std::size_t shell = 1; shell <= shells; ++shell)
    {
      tissue.name = model->GetName() + (shells > 1 ? " " + std::to_string(shell) : std::string());
      tissues.push_back(tissue);
    }
  }
  append->Update();
  vtkSmartPointer<vtkPolyData> result = append->GetOutput();
  setTissues(result->GetFieldData(), tissues);
  return result;
}

using Position = std::tuple<double, double, double>;

Position positionOf(vtkPointSet* mesh, vtkIdType point)
{
  double p[3];
  mesh->GetPoint(point, p);
  return { p[0], p[1], p[2] };
}

} // namespace

bool isLabelledSurface(vtkMRMLModelNode* model)
{
  return model->GetPolyData() && model->GetPolyData()->GetCellData()->GetArray("BoundaryLabels");
}

TissueTable tissuesOfSurface(vtkMRMLModelNode* model)
{
  TissueTable present;
  if (!isLabelledSurface(model)) return present;
  const TissueTable known = tissuesOf(model->GetPolyData()->GetFieldData());
  vtkDataArray* labels = model->GetPolyData()->GetCellData()->GetArray("BoundaryLabels");
  for (vtkIdType i = 0; i < labels->GetNumberOfTuples(); ++i)
  {
    for (int side = 0; side < labels->GetNumberOfComponents(); ++side)
    {
      const auto label = Label(labels->GetComponent(i, side));
      if (label == 0 || present.count(label) > 0) continue;
      const auto found = known.find(label);
      present[label] = found == known.end() ? Tissue() : found->second;
    }
  }
  return present;
}

vtkSmartPointer<vtkPolyData> surfaceInWorld(const std::vector<vtkMRMLModelNode*>& models)
{
  const bool labelled = models.size() == 1 && isLabelledSurface(models.front());
  const auto surface = labelled ? polyDataInWorld(models.front()) : closedSurfacesInWorld(models);
  surface->GetFieldData()->RemoveArray("SPACE");
  return surface;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const SurfaceComplex& surface)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points) points->InsertNextPoint(-p.x, -p.y, p.z);
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : surface.triangles) triangles->InsertNextCell({ a, b, c });
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(triangles);
  return result;
}

vtkSmartPointer<vtkUnstructuredGrid> ambientInWorld(vtkMRMLModelNode* ambient, vtkMRMLModelNode* surface)
{
  const auto grid = gridInWorld(ambient, surface);
  grid->GetFieldData()->RemoveArray("SPACE");
  return grid;
}

bool belongTogether(vtkMRMLModelNode* surface, vtkMRMLModelNode* ambient)
{
  vtkPointSet *part = surface->GetMesh(), *whole = ambient->GetMesh();
  if (!part || !whole) return false;
  std::set<Position> places;
  for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i) places.insert(positionOf(whole, i));
  for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
  {
    if (places.count(positionOf(part, i)) == 0) return false;
  }
  return true;
}

MeshFile meshOfModel(vtkMRMLModelNode* model)
{
  const std::string name = model->GetName() ? model->GetName() : "mesh";
  if (!model->GetUnstructuredGrid()) throw InputError(name + ": no unstructured grid, expected tetrahedra");
  return meshOfGrid(gridInWorld(model, model), true, name);
}

} // namespace surgicalmesher
