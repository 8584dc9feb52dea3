// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Adding nodes to the scene and removing them.

#include "vtkSurgicalMesherSupportLogicExport.h"

class vtkMRMLNode;
class vtkMRMLScene;
class vtkMRMLVolumeNode;

namespace surgicalmesher
{

/// Gives a volume without voxels a single voxel of value 0; other nodes are unchanged. For volumes that enter the scene
/// before a run fills them: Slicer may show a volume as soon as it is added, and crashes on drawing one without voxels.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void giveOneVoxel(vtkMRMLNode* node);

/// Whether a volume has more than the voxel of giveOneVoxel(). False for null.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT bool hasVoxels(vtkMRMLVolumeNode* volume);

/// Gives `to` the voxels of `from` and their position in the world in a single modification. When Slicer reads a file
/// into a volume, the volume is temporarily without voxels, and a slice view that shows it draws it in this state;
/// results are therefore read into a hidden volume first.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void takeVoxels(vtkMRMLVolumeNode* to, vtkMRMLVolumeNode* from);

/// Adds a node that the user does not see and that is not saved. A volume must already have voxels.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void addHidden(vtkMRMLScene* scene, vtkMRMLNode* node);

/// Removes a node with its display and storage nodes. Does nothing for null or a node in no scene.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void removeFromScene(vtkMRMLNode* node);

} // namespace surgicalmesher
