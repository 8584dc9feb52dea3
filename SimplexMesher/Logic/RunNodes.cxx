// SPDX-License-Identifier: Apache-2.0
#include "RunNodes.h"

#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

namespace surgicalmesher
{

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
