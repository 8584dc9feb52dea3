// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLTissueMapperNode.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTransformableNode.h>

#include <vtkObjectFactory.h>

vtkMRMLNodeNewMacro(vtkMRMLTissueMapperNode);

//----------------------------------------------------------------------------
vtkMRMLTissueMapperNode::vtkMRMLTissueMapperNode()
{
  this->AddRoles({ ImageRole(), SecondImageRole(), ThirdImageRole(), FourthImageRole(), FixedImageRole(),
                   MovingImageRole(), TubeImageRole() },
                 {}, { vtkMRMLTransformableNode::TransformModifiedEvent, vtkMRMLVolumeNode::ImageDataModifiedEvent });
  this->AddRoles({ TrainingRole(), TargetRole(), TubePointsRole() }, {},
                 { vtkMRMLTransformableNode::TransformModifiedEvent, vtkMRMLMarkupsNode::PointModifiedEvent,
                   vtkMRMLMarkupsNode::PointAddedEvent, vtkMRMLMarkupsNode::PointRemovedEvent });
  this->AddRoles({ LabelMapRole(), CompartmentsRole(), RegisteredImageRole(), TubePathRole() }, {});
}

std::vector<vtkMRMLSurgicalMesherParameterNode::Value> vtkMRMLTissueMapperNode::GetValues()
{
  return { { "trainingClass", &this->TrainingClass },
           { "classes", &this->Classes },
           { "correctBias", &this->CorrectBias },
           { "denoise", &this->Denoise },
           { "useCompartments", &this->UseCompartments },
           { "useContiguity", &this->UseContiguity },
           { "useProximity", &this->UseProximity },
           { "compartmentsAtOnce", &this->CompartmentsAtOnce },
           { "targetRadius", &this->TargetRadius },
           { "registrationStart", &this->RegistrationStart },
           { "tubeName", &this->TubeName },
           { "minimumRadius", &this->MinimumRadius },
           { "maximumRadius", &this->MaximumRadius },
           { "polarity", &this->Polarity },
           { "tubePotential", &this->TubePotential },
           { "tubeSnap", &this->TubeSnap },
           { "tubeMargin", &this->TubeMargin },
           { "traceAtOnce", &this->TraceAtOnce } };
}

void vtkMRMLTissueMapperNode::ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData)
{
  this->Superclass::ProcessMRMLEvents(caller, event, callData);
  if (this->GetScene() && caller != this->GetScene()) this->InvokeEvent(InputModifiedEvent);
}

//----------------------------------------------------------------------------
std::vector<vtkMRMLScalarVolumeNode*> vtkMRMLTissueMapperNode::GetImages()
{
  std::vector<vtkMRMLScalarVolumeNode*> images;
  for (const char* role : { ImageRole(), SecondImageRole(), ThirdImageRole(), FourthImageRole() })
  {
    if (vtkMRMLScalarVolumeNode* image = this->GetScalarVolumeNode(role)) images.push_back(image);
  }
  return images;
}

vtkMRMLScalarVolumeNode* vtkMRMLTissueMapperNode::GetTubeImage()
{
  if (vtkMRMLScalarVolumeNode* image = this->GetScalarVolumeNode(TubeImageRole())) return image;
  return this->GetScalarVolumeNode(ImageRole());
}

vtkMRMLMarkupsNode* vtkMRMLTissueMapperNode::GetMarkupsNode(const char* role)
{
  return vtkMRMLMarkupsNode::SafeDownCast(this->GetNodeReference(role));
}
