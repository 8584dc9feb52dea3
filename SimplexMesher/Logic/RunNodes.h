// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Nodes that runs of the module take and fill.

#include <vtkSmartPointer.h>

#include <string>

class vtkMRMLModelNode;
class vtkMRMLScalarVolumeNode;
class vtkMRMLScene;
class vtkMRMLTransformableNode;
class vtkMRMLVolumeNode;
class vtkMatrix4x4;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{

bool isUnderWarp(vtkMRMLTransformableNode* node);

/// From voxel indices to world, RAS; the parent transform has to be linear.
vtkSmartPointer<vtkMatrix4x4> voxelsToWorld(vtkMRMLVolumeNode* volume);

/// A hidden copy that shares its voxels and lies where the user sees the volume.
vtkSmartPointer<vtkMRMLScalarVolumeNode> copyForRun(vtkMRMLScalarVolumeNode* volume);

/// The host's own unique names count those of nodes that are gone, as after a cancelled run.
std::string unusedName(vtkMRMLScene* scene, const std::string& name);

/// `chosen`, or a new node in its place, as an output of `run`, in the world's frame.
vtkMRMLModelNode* outputModel(vtkMRMLModelNode* chosen, vtkMRMLScene* scene, const std::string& name,
                              vtkSurgicalMesherRun* run);

} // namespace surgicalmesher
