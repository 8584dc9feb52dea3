// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Nodes for runs of the module.

#include <string>

class vtkMRMLModelNode;
class vtkMRMLScene;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{

/// Returns `name`, made unique only if a node has it. Slicer's own unique names also count removed nodes, as after a
/// cancelled run.
std::string unusedName(vtkMRMLScene* scene, const std::string& name);

/// Returns `chosen`, or a new node if it is null, registered as output of `run`, without a parent transform.
vtkMRMLModelNode* outputModel(vtkMRMLModelNode* chosen, vtkMRMLScene* scene, const std::string& name,
                              vtkSurgicalMesherRun* run);

} // namespace surgicalmesher
