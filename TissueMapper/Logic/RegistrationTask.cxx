// SPDX-License-Identifier: Apache-2.0
#include "RegistrationTask.h"

#include "ClassificationTask.h"
#include "HostDifferences.h"
#include "MarkupsInput.h"
#include "Text.h"
#include "TextFile.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>

#include <rapidjson/document.h>

namespace surgicalmesher
{

using Node = vtkMRMLTissueMapperNode;

TaskCheck RegistrationTask::findProblem(vtkMRMLTissueMapperNode* parameters)
{
  vtkMRMLScalarVolumeNode* fixed = parameters->GetScalarVolumeNode(Node::FixedImageRole());
  vtkMRMLScalarVolumeNode* moving = parameters->GetScalarVolumeNode(Node::MovingImageRole());
  const TaskCheck check = checkImage(fixed);
  if (check.problem != TaskCheck::None) return check;
  if (!moving) return { TaskCheck::NoMoving, {} };
  if (moving == fixed) return { TaskCheck::SameImage, moving->GetName() };
  return checkImage(moving);
}

void RegistrationTask::prepare(vtkMRMLTissueMapperNode* parameters)
{
  vtkSurgicalMesherRun* run = this->run();
  const auto add = [&](const char* parameter, const char* role)
  {
    const auto copy = copyForRun(parameters->GetScalarVolumeNode(role));
    run->AddTemporaryNode(copy);
    run->SetParameterNode(parameter, copy);
  };
  add("fixed", Node::FixedImageRole());
  add("moving", Node::MovingImageRole());
  std::string sphere = "0,0,0,0"; // none
  const std::vector<Vec3> target = markupsPoints(parameters->GetMarkupsNode(Node::TargetRole()));
  if (!target.empty())
  {
    sphere.clear();
    for (int axis = 0; axis < 3; ++axis) sphere += text::rounded(target.front()[axis], 12) + ",";
    sphere += text::rounded(parameters->GetTargetRadius(), 12);
  }
  run->SetParameter("sphere", sphere);
  run->SetParameter("initial", parameters->GetRegistrationStart());
  m_ReportFile = run->NewTemporaryFile(".json");
  run->SetParameter("report", m_ReportFile);
  m_Registered.request(run, "registered", vtkSmartPointer<vtkMRMLScalarVolumeNode>::New());
}

void RegistrationTask::deliver(vtkMRMLTissueMapperNode* parameters)
{
  if (!m_Registered.isRead()) return;
  rapidjson::Document report;
  report.Parse(text::readTextFile(m_ReportFile).c_str());
  m_Found.agreeingStarts = report["agreeingStarts"].GetInt();
  m_Found.otherStarts = report["otherStarts"].GetInt();
  m_Found.scale = report["scale"].GetDouble();
  vtkMRMLNode* moving = parameters->GetNodeReference(Node::MovingImageRole());
  const std::string name = (moving ? moving->GetName() + std::string(" ") : std::string()) +
                           vtkMRMLTr("vtkSlicerTissueMapperLogic", "registered");
  parameters->SetNode(
    Node::RegisteredImageRole(),
    m_Registered.deliver(parameters->GetScalarVolumeNode(Node::RegisteredImageRole()), parameters->GetScene(), name));
}

void RegistrationTask::forgetResults() { m_Registered.forget(); }

} // namespace surgicalmesher
