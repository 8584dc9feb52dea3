// SPDX-License-Identifier: Apache-2.0
#include "vtkSlicerTissueMapperLogic.h"

#include "ClassificationTask.h"
#include "TubeTask.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLApplicationLogic.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSelectionNode.h>

#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

using namespace surgicalmesher;

vtkStandardNewMacro(vtkSlicerTissueMapperLogic);

//----------------------------------------------------------------------------
vtkSlicerTissueMapperLogic::vtkSlicerTissueMapperLogic()
  : Classification(std::make_unique<surgicalmesher::ClassificationTask>()),
    Tracing(std::make_unique<TubeTask>(TubeTask::Path)), Adding(std::make_unique<TubeTask>(TubeTask::PathAndTissue))
{
}

vtkSlicerTissueMapperLogic::~vtkSlicerTissueMapperLogic() = default;

void vtkSlicerTissueMapperLogic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const Task task : { Classify, TraceTube, AddTube })
  {
    os << indent << "Run of " << this->TaskOf(task).module() << ":\n";
    this->GetRun(task)->PrintSelf(os, indent.GetNextIndent());
  }
}

void vtkSlicerTissueMapperLogic::RegisterNodes()
{
  this->GetMRMLScene()->RegisterNodeClass(vtkSmartPointer<vtkMRMLTissueMapperNode>::New());
}

vtkMRMLTissueMapperNode* vtkSlicerTissueMapperLogic::ParameterNode()
{
  vtkMRMLScene* scene = this->GetMRMLScene();
  if (!scene) return nullptr;
  const char* className = "vtkMRMLTissueMapperNode";
  vtkMRMLNode* node = scene->GetFirstNodeByClass(className);
  if (!node) node = scene->AddNewNodeByClass(className, "Tissue Mapper");
  return vtkMRMLTissueMapperNode::SafeDownCast(node);
}

//----------------------------------------------------------------------------
PanelTask& vtkSlicerTissueMapperLogic::TaskOf(Task task) const
{
  switch (task)
  {
  case TraceTube: return *this->Tracing;
  case AddTube: return *this->Adding;
  default: return *this->Classification;
  }
}

TaskCheck vtkSlicerTissueMapperLogic::FindProblem(Task task, vtkMRMLTissueMapperNode* parameters)
{
  PanelTask& found = this->TaskOf(task);
  if (!this->GetModuleLogic(found.module().c_str())) return { TaskCheck::NoModule, found.module() };
  return found.findProblem(parameters);
}

TaskCheck vtkSlicerTissueMapperLogic::Start(Task task, vtkMRMLTissueMapperNode* parameters)
{
  PanelTask& found = this->TaskOf(task);
  if (found.run()->IsBusy()) return {};
  const TaskCheck check = this->FindProblem(task, parameters);
  if (check.problem != TaskCheck::None) return check;
  return found.start(this->GetModuleLogic(found.module().c_str()), parameters);
}

vtkSurgicalMesherRun* vtkSlicerTissueMapperLogic::GetRun(Task task) const { return this->TaskOf(task).run(); }

void vtkSlicerTissueMapperLogic::ShowTissues(vtkMRMLTissueMapperNode* parameters)
{
  vtkMRMLLabelMapVolumeNode* tissues = parameters->GetLabelMapNode(vtkMRMLTissueMapperNode::LabelMapRole());
  vtkMRMLApplicationLogic* application = this->GetMRMLApplicationLogic();
  if (!tissues || !application || !application->GetSelectionNode()) return;
  application->GetSelectionNode()->SetActiveLabelVolumeID(tissues->GetID());
  application->PropagateLabelVolumeSelection(0);
}

std::vector<std::string> vtkSlicerTissueMapperLogic::GetEmptyClasses() const
{
  return this->Classification->emptyClasses();
}

const FoundTube& vtkSlicerTissueMapperLogic::GetFoundTube(Task task) const
{
  return (task == AddTube ? this->Adding : this->Tracing)->found();
}
