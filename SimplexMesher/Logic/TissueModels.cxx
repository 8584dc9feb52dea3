// SPDX-License-Identifier: Apache-2.0
#include "TissueModels.h"

#include "HostDifferences.h"
#include "SceneNodes.h"
#include "TissueSurfaces.h"

#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSubjectHierarchyNode.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <string>
#include <vector>

namespace surgicalmesher
{
namespace
{

constexpr const char* kTissueModels = "tissueModels";        // role on the surface node
constexpr const char* kLabel = "SurgicalMesher.TissueLabel"; // attribute of a tissue's model
constexpr const char* kFolder = "SurgicalMesher.Tissues";    // attribute of the folder
constexpr const char* kTargetEdgeLength = "TargetEdgeLength";

/// Returns the complex of a model filled by the surface stage; empty for any other model. The frame of the model is
/// kept: RAS and LPS differ by a rotation, which preserves the orientation of triangles.
SurfaceFile complexOf(vtkPolyData* data)
{
  SurfaceFile content;
  vtkDataArray* labels = data ? data->GetCellData()->GetArray("BoundaryLabels") : nullptr;
  if (!labels || labels->GetNumberOfComponents() != 2) return content;
  content.tissues = tissuesOf(data->GetFieldData());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double* p = data->GetPoint(i);
    content.surface.points.push_back({ p[0], p[1], p[2] });
  }
  if (vtkDataArray* lengths = data->GetPointData()->GetArray(kTargetEdgeLength))
  {
    for (vtkIdType i = 0; i < lengths->GetNumberOfTuples(); ++i)
      content.targetEdgeLength.push_back(lengths->GetComponent(i, 0));
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < data->GetNumberOfCells(); ++t)
  {
    data->GetCellPoints(t, ids);
    if (ids->GetNumberOfIds() != 3) continue;
    content.surface.triangles.push_back(
      { std::int32_t(ids->GetId(0)), std::int32_t(ids->GetId(1)), std::int32_t(ids->GetId(2)) });
    content.surface.labels.push_back({ Label(labels->GetComponent(t, 0)), Label(labels->GetComponent(t, 1)) });
  }
  return content;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const SurfaceFile& content)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : content.surface.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> triangles;
  for (const auto& triangle : content.surface.triangles)
    triangles->InsertNextCell({ triangle[0], triangle[1], triangle[2] });
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  if (!content.targetEdgeLength.empty())
  {
    vtkNew<vtkDoubleArray> lengths;
    lengths->SetName(kTargetEdgeLength);
    for (const double length : content.targetEdgeLength) lengths->InsertNextValue(length);
    data->GetPointData()->AddArray(lengths);
  }
  return data;
}

std::map<Label, vtkMRMLModelNode*> earlierModels(vtkMRMLModelNode* surface)
{
  std::map<Label, vtkMRMLModelNode*> models;
  for (int i = 0; i < surface->GetNumberOfNodeReferences(kTissueModels); ++i)
  {
    auto* model = vtkMRMLModelNode::SafeDownCast(surface->GetNthNodeReference(kTissueModels, i));
    const char* label = model ? model->GetAttribute(kLabel) : nullptr;
    if (label) models[Label(std::stoi(label))] = model;
  }
  return models;
}

/// Returns the parent item of a node, or the item of the scene.
vtkIdType itemAbove(vtkMRMLSubjectHierarchyNode* hierarchy, vtkMRMLNode* node)
{
  const vtkIdType item = hierarchy->GetItemByDataNode(node);
  if (item == vtkMRMLSubjectHierarchyNode::INVALID_ITEM_ID) return hierarchy->GetSceneItemID();
  const vtkIdType above = hierarchy->GetItemParent(item);
  return above == vtkMRMLSubjectHierarchyNode::INVALID_ITEM_ID ? hierarchy->GetSceneItemID() : above;
}

/// Returns the folder that contains one of these models; INVALID_ITEM_ID if the user has moved all of them.
vtkIdType earlierFolder(vtkMRMLSubjectHierarchyNode* hierarchy, const std::map<Label, vtkMRMLModelNode*>& models)
{
  for (const auto& [label, model] : models)
  {
    const vtkIdType folder = itemAbove(hierarchy, model);
    if (hierarchy->HasItemAttribute(folder, kFolder)) return folder;
  }
  return vtkMRMLSubjectHierarchyNode::INVALID_ITEM_ID;
}

vtkIdType newFolder(vtkMRMLSubjectHierarchyNode* hierarchy, vtkMRMLModelNode* surface)
{
  const std::string name = surface->GetName() + (" " + vtkMRMLTr("SimplexMesher", "tissues"));
  const vtkIdType folder = hierarchy->CreateFolderItem(itemAbove(hierarchy, surface), name);
  hierarchy->SetItemAttribute(folder, kFolder, "1");
  return folder;
}

vtkMRMLModelNode* newModel(vtkMRMLModelNode* surface, Label label)
{
  auto* model = vtkMRMLModelNode::SafeDownCast(surface->GetScene()->AddNewNodeByClass("vtkMRMLModelNode"));
  model->SetAttribute(kLabel, std::to_string(label).c_str());
  surface->AddNodeReferenceID(kTissueModels, model->GetID());
  return model;
}

} // namespace

void makeTissueModels(vtkMRMLModelNode* surface)
{
  const SurfaceFile content = complexOf(surface->GetPolyData());
  std::map<Label, vtkMRMLModelNode*> earlier = earlierModels(surface);
  vtkMRMLSubjectHierarchyNode* hierarchy = vtkMRMLSubjectHierarchyNode::GetSubjectHierarchyNode(surface->GetScene());
  vtkIdType folder = earlierFolder(hierarchy, earlier);
  if (folder == vtkMRMLSubjectHierarchyNode::INVALID_ITEM_ID) folder = newFolder(hierarchy, surface);
  for (const auto& [label, part] : tissueSurfaces(content))
  {
    const bool isNew = earlier.count(label) == 0;
    vtkMRMLModelNode* model = isNew ? newModel(surface, label) : earlier[label];
    earlier.erase(label);
    const auto known = content.tissues.find(label);
    const Tissue tissue = known == content.tissues.end() ? Tissue() : known->second;
    model->SetName((tissue.name.empty() ? std::to_string(label) : tissue.name).c_str());
    model->SetAndObserveMesh(polyDataOf(part));
    model->CreateDefaultDisplayNodes();
    model->GetDisplayNode()->SetColor(tissue.color[0], tissue.color[1], tissue.color[2]);
    if (isNew) hierarchy->CreateItem(folder, model);
  }
  for (const auto& [label, model] : earlier) removeFromScene(model);
}

void removeTissueModels(vtkMRMLModelNode* surface)
{
  const std::map<Label, vtkMRMLModelNode*> models = earlierModels(surface);
  if (models.empty()) return;
  vtkMRMLSubjectHierarchyNode* hierarchy = vtkMRMLSubjectHierarchyNode::GetSubjectHierarchyNode(surface->GetScene());
  const vtkIdType folder = earlierFolder(hierarchy, models);
  for (const auto& [label, model] : models) removeFromScene(model);
  const bool exists = folder != vtkMRMLSubjectHierarchyNode::INVALID_ITEM_ID;
  if (exists && hierarchy->GetNumberOfItemChildren(folder) == 0) hierarchy->RemoveItem(folder, false, false);
}

} // namespace surgicalmesher
