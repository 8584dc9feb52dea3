// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Volumes of the scene as inputs and results of a run.

#include "vtkSurgicalMesherSupportLogicExport.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkMatrix4x4;
class vtkMRMLScalarVolumeNode;
class vtkMRMLScene;
class vtkMRMLTransformableNode;
class vtkMRMLVolumeNode;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{

/// Whether a nonlinear transform lies between `node` and the world.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT bool isUnderWarp(vtkMRMLTransformableNode* node);

/// Returns the matrix from voxel indices to world, RAS; the parent transform must be linear.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkSmartPointer<vtkMatrix4x4> voxelsToWorld(vtkMRMLVolumeNode* volume);

/// Whether both volumes have the same voxels in the world; neither may be under a nonlinear transform.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT bool isOnSameGrid(vtkMRMLVolumeNode* a, vtkMRMLVolumeNode* b);

/// Returns a separate node with the voxels of `volume` at their world position; it is not in the scene.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkSmartPointer<vtkMRMLScalarVolumeNode>
copyForRun(vtkMRMLScalarVolumeNode* volume);

/// A volume that a run creates. Slicer empties a node before it reads a file into it, which causes errors in slice
/// views that show it. The result is therefore read into a hidden node, whose voxels are moved to the user's node after
/// a successful run.
class VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT VolumeResult
{
public:
  /// `hidden` is a new node of the required class; it becomes the value of `parameter` of the run.
  void request(vtkSurgicalMesherRun* run, const char* parameter, vtkSmartPointer<vtkMRMLVolumeNode> hidden);
  /// Whether Slicer has read a file into the hidden node.
  bool isRead() const;
  /// Gives the voxels to `chosen` or, if that is null, to a new node of `scene` with this name; returns the node.
  vtkMRMLVolumeNode* deliver(vtkMRMLVolumeNode* chosen, vtkMRMLScene* scene, const std::string& name) const;
  void forget();

private:
  vtkSmartPointer<vtkMRMLVolumeNode> m_Hidden;
};

} // namespace surgicalmesher
