// SPDX-License-Identifier: Apache-2.0
#include "ModelMeshes.h"

#include "ElementQuality.h"

#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkAssignAttribute.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkGeneralTransform.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace surgicalmesher
{
namespace
{

/// Converts points from LPS to RAS, or back.
vtkSmartPointer<vtkPoints> turned(vtkPoints* points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(points->GetNumberOfPoints());
  double p[3];
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    points->GetPoint(i, p);
    result->SetPoint(i, -p[0], -p[1], p[2]);
  }
  return result;
}

vtkSmartPointer<vtkPoints> pointsInWorld(vtkMRMLModelNode* model)
{
  vtkPoints* points = model->GetMesh()->GetPoints();
  if (!model->GetParentTransformNode()) return turned(points);
  vtkNew<vtkGeneralTransform> toWorld;
  vtkMRMLTransformNode::GetTransformBetweenNodes(model->GetParentTransformNode(), nullptr, toWorld);
  vtkNew<vtkPoints> moved;
  moved->SetDataTypeToDouble();
  toWorld->TransformPoints(points, moved);
  return turned(moved);
}

void addQuality(const ElementMeshFile& content)
{
  const std::vector<Element>& elements = content.mesh.elements;
  if (std::none_of(elements.begin(), elements.end(), [](const Element& element) { return isVolume(element); })) return;
  vtkNew<vtkDoubleArray> values;
  values->SetName(kQualityArray);
  for (const ElementQuality& quality : elementQuality(content.mesh)) values->InsertNextValue(quality.minimum);
  content.data->GetCellData()->AddArray(values);
}

} // namespace

bool hasCells(vtkMRMLModelNode* model) { return model->GetMesh() && model->GetMesh()->GetNumberOfCells() > 0; }

std::string extensionFor(vtkMRMLModelNode* model) { return model->GetPolyData() ? ".vtp" : ".vtu"; }

ElementMeshFile meshInWorld(vtkMRMLModelNode* model)
{
  const auto mesh = vtkSmartPointer<vtkPointSet>::Take(model->GetMesh()->NewInstance());
  mesh->ShallowCopy(model->GetMesh());
  mesh->SetPoints(pointsInWorld(model));
  vtkNew<vtkFieldData> fields; // a copy, so that the model's own field data get no SPACE
  fields->ShallowCopy(model->GetMesh()->GetFieldData());
  mesh->SetFieldData(fields);
  return elementMeshOf(mesh, model->GetName() ? model->GetName() : "model");
}

void writeModel(vtkMRMLModelNode* model, const std::string& file)
{
  const ElementMeshFile content = meshInWorld(model);
  writeElementMesh(content, content.mesh.points, file, file);
}

void readIntoModel(const std::string& file, vtkMRMLModelNode* model)
{
  const ElementMeshFile content = readElementMesh(file);
  addQuality(content);
  content.data->SetPoints(turned(content.data->GetPoints()));
  content.data->GetFieldData()->RemoveArray("SPACE");
  const int wasModifying = model->StartModify();
  model->SetAndObserveTransformNodeID(nullptr);
  model->SetAndObserveMesh(content.data);
  model->EndModify(wasModifying);
  if (!model->GetDisplayNode()) model->CreateDefaultDisplayNodes();
}

void showQuality(vtkMRMLModelNode* model, bool isShown)
{
  vtkMRMLDisplayNode* display = model->GetDisplayNode();
  if (!display || !model->GetMesh() || !model->GetMesh()->GetCellData()->HasArray(kQualityArray)) return;
  const int wasModifying = display->StartModify();
  if (isShown)
  {
    display->SetActiveScalar(kQualityArray, vtkAssignAttribute::CELL_DATA);
    display->SetAndObserveColorNodeID("vtkMRMLColorTableNodeFileViridis.txt");
    display->SetScalarRangeFlag(vtkMRMLDisplayNode::UseManualScalarRange);
    display->SetScalarRange(0, 1);
  }
  display->SetScalarVisibility(isShown);
  display->EndModify(wasModifying);
}

} // namespace surgicalmesher
