// SPDX-License-Identifier: Apache-2.0
#include "vtkSlicerTissueMapperLogic.h"

#include "ClassificationTask.h"
#include "RegistrationTask.h"
#include "TubeTask.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLApplicationLogic.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSelectionNode.h>
#include <vtkMRMLSliceCompositeNode.h>

#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

using namespace surgicalmesher;

namespace
{

/// Returns the nodes that define what each slice view shows.
std::vector<vtkMRMLSliceCompositeNode*> sliceViews(vtkMRMLScene* scene)
{
  std::vector<vtkMRMLNode*> nodes;
  scene->GetNodesByClass("vtkMRMLSliceCompositeNode", nodes);
  std::vector<vtkMRMLSliceCompositeNode*> views;
  for (vtkMRMLNode* node : nodes) views.push_back(vtkMRMLSliceCompositeNode::SafeDownCast(node));
  return views;
}

} // namespace

vtkStandardNewMacro(vtkSlicerTissueMapperLogic);

//----------------------------------------------------------------------------
vtkSlicerTissueMapperLogic::vtkSlicerTissueMapperLogic()
  : Classification(std::make_unique<ClassificationTask>(ClassificationTask::Tissues)),
    Compartments(std::make_unique<ClassificationTask>(ClassificationTask::Compartments)),
    Registration(std::make_unique<RegistrationTask>()), Tracing(std::make_unique<TubeTask>(TubeTask::Path)),
    Adding(std::make_unique<TubeTask>(TubeTask::PathAndTissue))
{
}

vtkSlicerTissueMapperLogic::~vtkSlicerTissueMapperLogic() = default;

void vtkSlicerTissueMapperLogic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const Task task : { Classify, FindCompartments, Register, TraceTube, AddTube })
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
  case FindCompartments: return *this->Compartments;
  case Register: return *this->Registration;
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

void vtkSlicerTissueMapperLogic::ShowLabelMap(vtkMRMLNode* labelMap)
{
  vtkMRMLApplicationLogic* application = this->GetMRMLApplicationLogic();
  if (!application || !application->GetSelectionNode()) return;
  application->GetSelectionNode()->SetActiveLabelVolumeID(labelMap ? labelMap->GetID() : nullptr);
  application->PropagateLabelVolumeSelection(0);
  for (vtkMRMLSliceCompositeNode* view : sliceViews(this->GetMRMLScene())) view->SetLabelOpacity(0.5);
}

void vtkSlicerTissueMapperLogic::ShowRegistered(vtkMRMLTissueMapperNode* parameters)
{
  vtkMRMLNode* fixed = parameters->GetNodeReference(vtkMRMLTissueMapperNode::FixedImageRole());
  vtkMRMLNode* registered = parameters->GetNodeReference(vtkMRMLTissueMapperNode::RegisteredImageRole());
  vtkMRMLApplicationLogic* application = this->GetMRMLApplicationLogic();
  if (!fixed || !registered || !application || !application->GetSelectionNode()) return;
  application->GetSelectionNode()->SetActiveVolumeID(fixed->GetID());
  application->GetSelectionNode()->SetSecondaryVolumeID(registered->GetID());
  application->PropagateBackgroundVolumeSelection(0);
  application->PropagateForegroundVolumeSelection(0);
  for (vtkMRMLSliceCompositeNode* view : sliceViews(this->GetMRMLScene())) view->SetForegroundOpacity(0.5);
}

std::vector<std::string> vtkSlicerTissueMapperLogic::GetEmptyClasses() const
{
  return this->Classification->emptyClasses();
}

const FoundRegistration& vtkSlicerTissueMapperLogic::GetFoundRegistration() const
{
  return this->Registration->found();
}

const FoundTube& vtkSlicerTissueMapperLogic::GetFoundTube(Task task) const
{
  return (task == AddTube ? this->Adding : this->Tracing)->found();
}
