// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Nodes that the modules put into the scene, and take out of it.

#include "vtkSurgicalMesherSupportLogicExport.h"

class vtkMRMLNode;
class vtkMRMLScene;
class vtkMRMLVolumeNode;

namespace surgicalmesher
{

/// One voxel of value 0 for a volume without any; other nodes stay as they are. For volumes that enter the scene before
/// a run fills them: the host may show a volume as soon as it is added, and crash on drawing one without voxels.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void giveOneVoxel(vtkMRMLNode* node);

/// Whether a volume has more than the voxel of giveOneVoxel(). Null has nothing.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT bool hasVoxels(vtkMRMLVolumeNode* volume);

/// The voxels of `from`, and where they lie in the world, at once. The host reads a file into a volume by way of having
/// none, and draws it so if a slice view shows it: results that it reads go to a hidden volume first.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void takeVoxels(vtkMRMLVolumeNode* to, vtkMRMLVolumeNode* from);

/// The user neither sees nor saves it. A volume has voxels before.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void addHidden(vtkMRMLScene* scene, vtkMRMLNode* node);

/// With its display and storage nodes. Null, or a node in no scene, is nothing to do.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void removeFromScene(vtkMRMLNode* node);

} // namespace surgicalmesher
