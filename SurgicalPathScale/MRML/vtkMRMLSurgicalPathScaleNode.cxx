// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLSurgicalPathScaleNode.h"

#include <vtkMRMLMarkupsCurveNode.h>
#include <vtkMRMLMarkupsLineNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTransformableNode.h>
#include <vtkMRMLVolumeNode.h>
#include <vtkSegmentation.h>

#include <vtkObjectFactory.h>

namespace
{

bool isPath(vtkMRMLMarkupsNode* node)
{
  return vtkMRMLMarkupsCurveNode::SafeDownCast(node) || vtkMRMLMarkupsLineNode::SafeDownCast(node);
}

/// Returns all of `chosen`, and those of `further` that are paths or, if `paths` is false, that are not.
std::vector<vtkMRMLMarkupsNode*> markupsOf(const std::vector<vtkMRMLNode*>& chosen,
                                           const std::vector<vtkMRMLNode*>& further, bool paths)
{
  std::vector<vtkMRMLMarkupsNode*> nodes;
  for (vtkMRMLNode* each : chosen)
  {
    if (auto* node = vtkMRMLMarkupsNode::SafeDownCast(each)) nodes.push_back(node);
  }
  for (vtkMRMLNode* each : further)
  {
    auto* node = vtkMRMLMarkupsNode::SafeDownCast(each);
    if (node && isPath(node) == paths) nodes.push_back(node);
  }
  return nodes;
}

} // namespace

vtkMRMLNodeNewMacro(vtkMRMLSurgicalPathScaleNode);

//----------------------------------------------------------------------------
vtkMRMLSurgicalPathScaleNode::vtkMRMLSurgicalPathScaleNode()
{
  this->AddRoles({ TissueMapRole() }, {},
                 { vtkMRMLTransformableNode::TransformModifiedEvent, vtkMRMLVolumeNode::ImageDataModifiedEvent,
                   vtkSegmentation::SegmentAdded, vtkSegmentation::SegmentRemoved, vtkSegmentation::SegmentModified,
                   vtkSegmentation::ContainedRepresentationNamesModified, vtkSegmentation::RepresentationModified,
                   vtkSegmentation::SegmentsOrderModified });
  this->AddRoles({ TargetsRole(), PathRole(), FurtherMarkupsRole() }, {},
                 { vtkMRMLTransformableNode::TransformModifiedEvent, vtkMRMLMarkupsNode::PointModifiedEvent,
                   vtkMRMLMarkupsNode::PointAddedEvent, vtkMRMLMarkupsNode::PointRemovedEvent });
  this->AddRoles({ ScaleRole(), OutputLabelMapRole(), ProfileChartRole() }, {});
}

std::vector<vtkMRMLSurgicalMesherParameterNode::Value> vtkMRMLSurgicalPathScaleNode::GetValues()
{
  return { { "minimumEdgeLength", &this->MinimumEdgeLength },
           { "maximumEdgeLength", &this->MaximumEdgeLength },
           { "childRadius", &this->ChildRadius },
           { "decayLength", &this->DecayLength },
           { "spacing", &this->Spacing },
           { "pathChildRadius", &this->PathChildRadius },
           { "pathDecayLength", &this->PathDecayLength },
           { "gradation", &this->Gradation },
           { "combine", &this->Combine },
           { "tissueLengths", &this->TissueLengths },
           { "nullDisplacementRadius", &this->NullDisplacementRadius },
           { "nullDisplacementPathDistance", &this->NullDisplacementPathDistance },
           { "nullDisplacementPathDistanceAtTarget", &this->NullDisplacementPathDistanceAtTarget },
           { "nullDisplacementTissues", &this->NullDisplacementTissues } };
}

void vtkMRMLSurgicalPathScaleNode::ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData)
{
  this->Superclass::ProcessMRMLEvents(caller, event, callData);
  if (this->GetScene() && caller != this->GetScene()) this->InvokeEvent(InputModifiedEvent);
}

//----------------------------------------------------------------------------
std::vector<vtkMRMLMarkupsNode*> vtkMRMLSurgicalPathScaleNode::GetTargetNodes()
{
  return markupsOf(this->GetNodes(TargetsRole()), this->GetNodes(FurtherMarkupsRole()), false);
}

std::vector<vtkMRMLMarkupsNode*> vtkMRMLSurgicalPathScaleNode::GetPathNodes()
{
  return markupsOf(this->GetNodes(PathRole()), this->GetNodes(FurtherMarkupsRole()), true);
}

bool vtkMRMLSurgicalPathScaleNode::WantsNullDisplacement() const
{
  return this->NullDisplacementRadius > 0 || this->NullDisplacementPathDistance > 0;
}
