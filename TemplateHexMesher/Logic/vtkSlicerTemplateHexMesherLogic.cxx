// SPDX-License-Identifier: Apache-2.0
#include "vtkSlicerTemplateHexMesherLogic.h"

#include "ModelMeshes.h"
#include "vtkMRMLTemplateHexMesherNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

using namespace surgicalmesher;
using Node = vtkMRMLTemplateHexMesherNode;

namespace
{

constexpr const char* moduleName = "TemplateFitCLI";

}

vtkStandardNewMacro(vtkSlicerTemplateHexMesherLogic);

//----------------------------------------------------------------------------
vtkSlicerTemplateHexMesherLogic::vtkSlicerTemplateHexMesherLogic() : Fit(std::make_unique<FitTask>()) {}

vtkSlicerTemplateHexMesherLogic::~vtkSlicerTemplateHexMesherLogic() = default;

void vtkSlicerTemplateHexMesherLogic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Run:\n";
  this->GetRun()->PrintSelf(os, indent.GetNextIndent());
}

void vtkSlicerTemplateHexMesherLogic::RegisterNodes()
{
  this->GetMRMLScene()->RegisterNodeClass(vtkSmartPointer<vtkMRMLTemplateHexMesherNode>::New());
}

vtkMRMLTemplateHexMesherNode* vtkSlicerTemplateHexMesherLogic::ParameterNode()
{
  vtkMRMLScene* scene = this->GetMRMLScene();
  if (!scene) return nullptr;
  const char* className = "vtkMRMLTemplateHexMesherNode";
  vtkMRMLNode* node = scene->GetFirstNodeByClass(className);
  if (!node) node = scene->AddNewNodeByClass(className, "Template Hex Mesher");
  return vtkMRMLTemplateHexMesherNode::SafeDownCast(node);
}

//----------------------------------------------------------------------------
FitCheck vtkSlicerTemplateHexMesherLogic::FindProblem(vtkMRMLTemplateHexMesherNode* parameters)
{
  if (!this->GetModuleLogic(moduleName)) return { FitCheck::NoModule, moduleName };
  return FitTask::findProblem(parameters);
}

FitCheck vtkSlicerTemplateHexMesherLogic::Start(vtkMRMLTemplateHexMesherNode* parameters)
{
  if (this->GetRun()->IsBusy()) return {};
  const FitCheck check = this->FindProblem(parameters);
  if (check.problem != FitCheck::None) return check;
  return this->Fit->start(this->GetModuleLogic(moduleName), parameters);
}

vtkSurgicalMesherRun* vtkSlicerTemplateHexMesherLogic::GetRun() const { return this->Fit->run(); }

FitSummary vtkSlicerTemplateHexMesherLogic::GetFound(vtkMRMLTemplateHexMesherNode* parameters) const
{
  return this->Fit->found(parameters);
}

//----------------------------------------------------------------------------
std::vector<LandmarkRow> vtkSlicerTemplateHexMesherLogic::GetLandmarks(vtkMRMLTemplateHexMesherNode* parameters)
{
  return landmarkRows(parameters->GetMarkupsNode(Node::TemplateLandmarksRole()),
                      parameters->GetMarkupsNode(Node::TargetLandmarksRole()), this->GetFound(parameters).residuals);
}

void vtkSlicerTemplateHexMesherLogic::UpdateDisplay(vtkMRMLTemplateHexMesherNode* parameters)
{
  if (!parameters->GetScene() || this->GetRun()->IsStarting()) return;
  this->Preview.update(parameters);
  this->Views.update(parameters, this->GetPreview());
  if (vtkMRMLModelNode* fitted = parameters->GetModelNode(Node::FittedRole()))
    showQuality(fitted, parameters->GetColorByQuality());
}

vtkMRMLModelNode* vtkSlicerTemplateHexMesherLogic::GetPreview() const { return this->Preview.model(); }
