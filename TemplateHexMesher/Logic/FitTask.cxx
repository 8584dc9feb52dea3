// SPDX-License-Identifier: Apache-2.0
#include "FitTask.h"

#include "Errors.h"
#include "HostDifferences.h"
#include "LandmarkLists.h"
#include "MarkupsInput.h"
#include "ModelMeshes.h"
#include "vtkMRMLTemplateHexMesherNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTableNode.h>

#include <vtkCallbackCommand.h>
#include <vtksys/SystemTools.hxx>

namespace surgicalmesher
{
namespace
{

using Node = vtkMRMLTemplateHexMesherNode;

FitCheck checkModels(Node* parameters)
{
  vtkMRMLModelNode* source = parameters->GetModelNode(Node::TemplateRole());
  vtkMRMLModelNode* target = parameters->GetModelNode(Node::TargetRole());
  vtkMRMLModelNode* inner = parameters->GetModelNode(Node::InnerRole());
  if (!source) return { FitCheck::NoTemplate, {} };
  if (!target) return { FitCheck::NoTarget, {} };
  if (source == target) return { FitCheck::SameModel, source->GetName() };
  for (vtkMRMLModelNode* model : { source, target, inner })
  {
    if (model && !hasCells(model)) return { FitCheck::NoCells, model->GetName() };
  }
  return {};
}

FitCheck checkLandmarks(Node* parameters)
{
  vtkMRMLMarkupsNode* onTemplate = parameters->GetMarkupsNode(Node::TemplateLandmarksRole());
  vtkMRMLMarkupsNode* onTarget = parameters->GetMarkupsNode(Node::TargetLandmarksRole());
  const NamedPoints source = namedPoints(onTemplate), target = namedPoints(onTarget);
  if (source.names.empty() || target.names.empty()) return { FitCheck::NoLandmarks, {} };
  if (onTemplate == onTarget) return { FitCheck::SameList, source.file };
  try
  {
    requireUsable(pairedByName(source, target), source.file, target.file);
  }
  catch (const Error& error)
  {
    return { FitCheck::Refused, error.what() };
  }
  return {};
}

/// Returns the chosen result node, or adds a new one to the scene.
template <class Result>
Result* resultNode(Node* parameters, const char* role, int n, const char* className, const std::string& name)
{
  if (auto* node = Result::SafeDownCast(parameters->GetNthNodeReference(role, n))) return node;
  vtkMRMLScene* scene = parameters->GetScene();
  auto* node = Result::SafeDownCast(scene->AddNewNodeByClass(className, scene->GenerateUniqueName(name)));
  parameters->SetNthNodeReferenceID(role, n, node->GetID());
  return node;
}

} // namespace

FitTask::FitTask()
{
  m_Ended->SetClientData(this);
  m_Ended->SetCallback([](vtkObject*, unsigned long, void* self, void*) { static_cast<FitTask*>(self)->end(); });
  m_Run->AddObserver(vtkSurgicalMesherRun::CompletedEvent, m_Ended, 1); // priority above that of the panel's observer
}

FitTask::~FitTask() { m_Run->RemoveObserver(m_Ended); }

FitCheck FitTask::findProblem(Node* parameters)
{
  const FitCheck models = checkModels(parameters);
  return models.problem == FitCheck::None ? checkLandmarks(parameters) : models;
}

FitCheck FitTask::start(vtkMRMLAbstractLogic* module, Node* parameters)
{
  m_Run->SetCommandLineLogic(module);
  m_Parameters = parameters;
  try
  {
    this->prepare(parameters);
  }
  catch (const Error& error)
  {
    m_Run->SetCommandLineLogic(nullptr); // deletes the temporary files
    return { FitCheck::Refused, error.what() };
  }
  if (m_Run->Start()) return {};
  return { FitCheck::Refused, m_Run->GetErrorText() };
}

FitSummary FitTask::found(Node* parameters) const
{
  return m_FoundFor && m_FoundFor == parameters ? m_Found : FitSummary();
}

void FitTask::prepare(Node* parameters)
{
  vtkMRMLModelNode* source = parameters->GetModelNode(Node::TemplateRole());
  m_Name = source->GetName();
  m_Run->SetParameter("template", this->fileOf(source));
  m_Run->SetParameter("target", this->fileOf(parameters->GetModelNode(Node::TargetRole())));
  if (vtkMRMLModelNode* inner = parameters->GetModelNode(Node::InnerRole()))
    m_Run->SetParameter("inner", this->fileOf(inner));
  m_FittedFile = m_Run->NewTemporaryFile(extensionFor(source));
  m_Run->SetParameter("fitted", m_FittedFile);
  m_ReportFile = m_Run->NewTemporaryFile(".json");
  m_Run->SetParameter("report", m_ReportFile);
  this->prepareCarried(parameters);
  this->prepareLandmarks(parameters);
  m_Run->SetParameter("alpha", parameters->GetAlpha());
  m_Run->SetParameter("iterations", parameters->GetIterations());
  m_Run->SetParameter("landmarkWeight", parameters->GetLandmarkWeight());
}

std::string FitTask::fileOf(vtkMRMLModelNode* model)
{
  const std::string file = m_Run->NewTemporaryFile(extensionFor(model));
  writeModel(model, file);
  return file;
}

void FitTask::prepareCarried(Node* parameters)
{
  using vtksys::SystemTools;
  m_Carried.clear();
  std::string files;
  for (vtkMRMLNode* node : parameters->GetNodes(Node::CarriedRole()))
  {
    auto* model = vtkMRMLModelNode::SafeDownCast(node);
    if (!model || !hasCells(model)) continue;
    const std::string file = this->fileOf(model);
    files += (files.empty() ? "" : ",") + file;
    m_Carried.push_back({ SystemTools::GetFilenamePath(m_FittedFile) + "/" +
                            SystemTools::GetFilenameWithoutLastExtension(m_FittedFile) + "." +
                            SystemTools::GetFilenameWithoutLastExtension(file) + ".vtu",
                          model->GetName() });
  }
  if (!files.empty()) m_Run->SetParameter("carry", files);
}

void FitTask::prepareLandmarks(Node* parameters)
{
  std::string files;
  for (const char* role : { Node::TemplateLandmarksRole(), Node::TargetLandmarksRole() })
  {
    const std::string file = m_Run->NewTemporaryFile(".mrk.json");
    writeLabelledMarkups({ labelledPoints(parameters->GetMarkupsNode(role)) }, file);
    files += (files.empty() ? "" : ",") + file;
  }
  m_Run->SetParameter("landmarks", files);
}

void FitTask::end()
{
  try
  {
    if (m_Parameters && m_Parameters->GetScene() && m_Run->GetStatus() == vtkSurgicalMesherRun::Completed)
      this->deliver(m_Parameters);
  }
  catch (const Error& error)
  {
    m_Run->SetErrorText(error.what()); // the result files are missing or unreadable
  }
}

void FitTask::deliver(Node* parameters)
{
  const std::string words = vtkMRMLTr("vtkSlicerTemplateHexMesherLogic", "fitted");
  m_Found = readFitSummary(m_ReportFile);
  m_FoundFor = parameters;
  auto* fitted =
    resultNode<vtkMRMLModelNode>(parameters, Node::FittedRole(), 0, "vtkMRMLModelNode", m_Name + " " + words);
  readIntoModel(m_FittedFile, fitted);
  fitted->GetDisplayNode()->SetEdgeVisibility(true);
  showQuality(fitted, parameters->GetColorByQuality());
  this->deliverCarried(parameters);
  auto* table = resultNode<vtkMRMLTableNode>(parameters, Node::QualityTableRole(), 0, "vtkMRMLTableNode",
                                             fitted->GetName() + std::string(": ") +
                                               vtkMRMLTr("vtkSlicerTemplateHexMesherLogic", "quality"));
  fillQualityTable(m_ReportFile, table);
  parameters->SetShowPreview(false); // it would overlap the fitted mesh
  parameters->Modified();
}

void FitTask::deliverCarried(Node* parameters)
{
  for (std::size_t n = 0; n < m_Carried.size(); ++n)
  {
    const std::string name = m_Carried[n].name + " " + vtkMRMLTr("vtkSlicerTemplateHexMesherLogic", "fitted");
    readIntoModel(m_Carried[n].file, resultNode<vtkMRMLModelNode>(parameters, Node::CarriedResultRole(), int(n),
                                                                  "vtkMRMLModelNode", name));
  }
}

} // namespace surgicalmesher
