// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Volumes of the scene as inputs and as results of a run.

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

/// Whether a transform that isn't linear lies between `node` and the world.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT bool isUnderWarp(vtkMRMLTransformableNode* node);

/// From voxel indices to world, RAS; the parent transform has to be linear.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkSmartPointer<vtkMatrix4x4> voxelsToWorld(vtkMRMLVolumeNode* volume);

/// Whether both have the same voxels in the world; neither is under a warp.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT bool isOnSameGrid(vtkMRMLVolumeNode* a, vtkMRMLVolumeNode* b);

/// A node of its own with the voxels of `volume`, where the user sees them; not in the scene.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkSmartPointer<vtkMRMLScalarVolumeNode>
copyForRun(vtkMRMLScalarVolumeNode* volume);

/// A volume that a run makes. The host empties a node before it reads a file into it, which slice views that show it
/// complain of: it reads into a hidden one, whose voxels go to the user's when the run has ended well.
class VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT VolumeResult
{
public:
  /// `hidden` is a new node of the class that is wanted; `run` has it for its parameter of this name.
  void request(vtkSurgicalMesherRun* run, const char* parameter, vtkSmartPointer<vtkMRMLVolumeNode> hidden);
  /// Whether the host has read a file into it.
  bool isRead() const;
  /// Gives the voxels to `chosen`, or to a new node of `scene` of this name if that is null; returns it.
  vtkMRMLVolumeNode* deliver(vtkMRMLVolumeNode* chosen, vtkMRMLScene* scene, const std::string& name) const;
  void forget();

private:
  vtkSmartPointer<vtkMRMLVolumeNode> m_Hidden;
};

} // namespace surgicalmesher
