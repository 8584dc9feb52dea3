// SPDX-License-Identifier: Apache-2.0
#include "VolumeNodes.h"

#include "SceneNodes.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTransformNode.h>

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include <cmath>

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

bool isOnSameGrid(vtkMRMLVolumeNode* a, vtkMRMLVolumeNode* b)
{
  constexpr double tolerance = 1e-3; // in voxels, at the far corner
  int sizeA[3], sizeB[3];
  a->GetImageData()->GetDimensions(sizeA);
  b->GetImageData()->GetDimensions(sizeB);
  vtkNew<vtkMatrix4x4> toB; // from voxels of a
  vtkMatrix4x4::Invert(voxelsToWorld(b), toB);
  vtkMatrix4x4::Multiply4x4(toB, voxelsToWorld(a), toB);
  for (int row = 0; row < 3; ++row)
  {
    if (sizeA[row] != sizeB[row]) return false;
    double off = std::abs(toB->GetElement(row, 3));
    for (int axis = 0; axis < 3; ++axis)
      off += std::abs(toB->GetElement(row, axis) - (row == axis ? 1 : 0)) * sizeA[axis];
    if (off > tolerance) return false;
  }
  return true;
}

vtkSmartPointer<vtkMRMLScalarVolumeNode> copyForRun(vtkMRMLScalarVolumeNode* volume)
{
  auto copy = vtkSmartPointer<vtkMRMLScalarVolumeNode>::New();
  copy->SetName(volume->GetName());
  vtkNew<vtkImageData> image; // a separate image object for Slicer's writer, which runs in its own thread
  image->ShallowCopy(volume->GetImageData());
  copy->SetAndObserveImageData(image);
  copy->SetIJKToRASMatrix(voxelsToWorld(volume));
  return copy;
}

void VolumeResult::request(vtkSurgicalMesherRun* run, const char* parameter, vtkSmartPointer<vtkMRMLVolumeNode> hidden)
{
  m_Hidden = std::move(hidden);
  giveOneVoxel(m_Hidden);
  run->AddTemporaryNode(m_Hidden);
  run->SetParameterNode(parameter, m_Hidden);
}

bool VolumeResult::isRead() const { return hasVoxels(m_Hidden); }

/// A new node has its voxels before it enters the scene, where observers access it.
vtkMRMLVolumeNode* VolumeResult::deliver(vtkMRMLVolumeNode* chosen, vtkMRMLScene* scene, const std::string& name) const
{
  if (chosen)
  {
    takeVoxels(chosen, m_Hidden);
    return chosen;
  }
  const auto node = vtkSmartPointer<vtkMRMLVolumeNode>::Take(
    vtkMRMLVolumeNode::SafeDownCast(scene->CreateNodeByClass(m_Hidden->GetClassName())));
  node->SetName(scene->GenerateUniqueName(name).c_str());
  takeVoxels(node, m_Hidden);
  scene->AddNode(node);
  return node;
}

void VolumeResult::forget() { m_Hidden = nullptr; }

} // namespace surgicalmesher
