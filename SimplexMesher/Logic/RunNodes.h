// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Nodes that runs of the module take and fill.

#include <string>

class vtkMRMLModelNode;
class vtkMRMLScene;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{

/// The host's own unique names count those of nodes that are gone, as after a cancelled run.
std::string unusedName(vtkMRMLScene* scene, const std::string& name);

/// `chosen`, or a new node in its place, as an output of `run`, in the world's frame.
vtkMRMLModelNode* outputModel(vtkMRMLModelNode* chosen, vtkMRMLScene* scene, const std::string& name,
                              vtkSurgicalMesherRun* run);

} // namespace surgicalmesher
