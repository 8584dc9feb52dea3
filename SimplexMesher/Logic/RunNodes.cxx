// SPDX-License-Identifier: Apache-2.0
#include "RunNodes.h"

#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTransformNode.h>

#include <vtkMatrix4x4.h>

namespace surgicalmesher
{

bool isUnderWarp(vtkMRMLTransformableNode* node)
{
  vtkMRMLTransformNode* transform = node->GetParentTransformNode();
  return transform && !transform->IsTransformToWorldLinear();
}

vtkSmartPointer<vtkMatrix4x4> voxelsToWorld(vtkMRMLVolumeNode* volume)
{
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  volume->GetIJKToRASMatrix(matrix);
  if (vtkMRMLTransformNode* transform = volume->GetParentTransformNode())
  {
    vtkNew<vtkMatrix4x4> toWorld;
    transform->GetMatrixTransformToWorld(toWorld);
    vtkMatrix4x4::Multiply4x4(toWorld, matrix, matrix);
  }
  return matrix;
}

vtkSmartPointer<vtkMRMLScalarVolumeNode> copyForRun(vtkMRMLScalarVolumeNode* volume)
{
  auto copy = vtkSmartPointer<vtkMRMLScalarVolumeNode>::New();
  copy->SetName(volume->GetName());
  copy->SetAndObserveImageData(volume->GetImageData());
  copy->SetIJKToRASMatrix(voxelsToWorld(volume));
  return copy;
}

std::string unusedName(vtkMRMLScene* scene, const std::string& name)
{
  return scene->GetFirstNodeByName(name.c_str()) ? scene->GenerateUniqueName(name) : name;
}

vtkMRMLModelNode* outputModel(vtkMRMLModelNode* chosen, vtkMRMLScene* scene, const std::string& name,
                              vtkSurgicalMesherRun* run)
{
  vtkMRMLModelNode* node = chosen;
  if (!node)
  {
    node = vtkMRMLModelNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLModelNode", unusedName(scene, name)));
  }
  run->AddOutputNode(node, !chosen);
  node->SetAndObserveTransformNodeID(nullptr);
  return node;
}

} // namespace surgicalmesher
