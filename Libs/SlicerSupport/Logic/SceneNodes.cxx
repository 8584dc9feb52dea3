// SPDX-License-Identifier: Apache-2.0
#include "SceneNodes.h"

#include <vtkMRMLDisplayNode.h>
#include <vtkMRMLDisplayableNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLStorableNode.h>
#include <vtkMRMLStorageNode.h>
#include <vtkMRMLVolumeNode.h>

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace surgicalmesher
{

void giveOneVoxel(vtkMRMLNode* node)
{
  auto* volume = vtkMRMLVolumeNode::SafeDownCast(node);
  if (!volume || volume->GetImageData()) return;
  vtkNew<vtkImageData> image;
  image->SetDimensions(1, 1, 1);
  image->AllocateScalars(VTK_SHORT, 1);
  image->SetScalarComponentFromDouble(0, 0, 0, 0, 0);
  volume->SetAndObserveImageData(image);
}

bool hasVoxels(vtkMRMLVolumeNode* volume)
{
  vtkImageData* image = volume ? volume->GetImageData() : nullptr;
  if (!image || image->GetNumberOfPoints() == 0) return false;
  return image->GetNumberOfPoints() > 1 || image->GetScalarComponentAsDouble(0, 0, 0, 0) != 0;
}

void takeVoxels(vtkMRMLVolumeNode* to, vtkMRMLVolumeNode* from)
{
  vtkNew<vtkMatrix4x4> matrix;
  from->GetIJKToRASMatrix(matrix);
  const int wasModifying = to->StartModify();
  to->SetAndObserveTransformNodeID(nullptr);
  to->SetIJKToRASMatrix(matrix);
  to->SetAndObserveImageData(from->GetImageData());
  to->EndModify(wasModifying);
}

void addHidden(vtkMRMLScene* scene, vtkMRMLNode* node)
{
  node->SetHideFromEditors(true);
  node->SetSaveWithScene(false);
  scene->AddNode(node);
}

void removeFromScene(vtkMRMLNode* node)
{
  vtkMRMLScene* scene = node ? node->GetScene() : nullptr;
  if (!scene) return;
  std::vector<vtkSmartPointer<vtkMRMLNode>> nodes{ node };
  if (auto* displayable = vtkMRMLDisplayableNode::SafeDownCast(node))
  {
    for (int n = 0; n < displayable->GetNumberOfDisplayNodes(); ++n) nodes.push_back(displayable->GetNthDisplayNode(n));
  }
  if (auto* storable = vtkMRMLStorableNode::SafeDownCast(node))
  {
    for (int n = 0; n < storable->GetNumberOfStorageNodes(); ++n) nodes.push_back(storable->GetNthStorageNode(n));
  }
  for (vtkMRMLNode* each : nodes)
  {
    if (each && each->GetScene()) scene->RemoveNode(each);
  }
}

} // namespace surgicalmesher
