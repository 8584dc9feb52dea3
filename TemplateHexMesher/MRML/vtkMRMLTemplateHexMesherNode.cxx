// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLTemplateHexMesherNode.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTransformableNode.h>

#include <vtkObjectFactory.h>

vtkMRMLNodeNewMacro(vtkMRMLTemplateHexMesherNode);

//----------------------------------------------------------------------------
/// Models are not observed: Slicer warns when a node with observed events has a second role.
vtkMRMLTemplateHexMesherNode::vtkMRMLTemplateHexMesherNode()
{
  this->AddRoles({ TemplateLandmarksRole(), TargetLandmarksRole() }, {},
                 { vtkMRMLTransformableNode::TransformModifiedEvent, vtkMRMLMarkupsNode::PointModifiedEvent,
                   vtkMRMLMarkupsNode::PointAddedEvent, vtkMRMLMarkupsNode::PointRemovedEvent,
                   vtkMRMLMarkupsNode::PointPositionDefinedEvent });
  this->AddRoles(
    { TemplateRole(), TargetRole(), InnerRole(), CarriedRole(), FittedRole(), CarriedResultRole(), QualityTableRole() },
    {});
}

std::vector<vtkMRMLSurgicalMesherParameterNode::Value> vtkMRMLTemplateHexMesherNode::GetValues()
{
  return { { "sideBySide", &this->SideBySide },         { "showPreview", &this->ShowPreview },
           { "colorByQuality", &this->ColorByQuality }, { "alpha", &this->Alpha },
           { "iterations", &this->Iterations },         { "landmarkWeight", &this->LandmarkWeight } };
}

void vtkMRMLTemplateHexMesherNode::ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData)
{
  this->Superclass::ProcessMRMLEvents(caller, event, callData);
  if (this->GetScene() && caller != this->GetScene()) this->InvokeEvent(InputModifiedEvent);
}

vtkMRMLMarkupsNode* vtkMRMLTemplateHexMesherNode::GetMarkupsNode(const char* role)
{
  return vtkMRMLMarkupsNode::SafeDownCast(this->GetNodeReference(role));
}
