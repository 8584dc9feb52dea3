// SPDX-License-Identifier: Apache-2.0
#include "vtkSlicerSurgicalPathScaleLogic.h"

#include "Errors.h"
#include "HostDifferences.h"
#include "MarkupsInput.h"
#include "ScaleInputs.h"
#include "ScalePreview.h"
#include "SceneNodes.h"
#include "TissueColors.h"
#include "vtkMRMLSurgicalPathScaleNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>

#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdlib>

using namespace surgicalmesher;
using Node = vtkMRMLSurgicalPathScaleNode;

namespace
{

/// Adds an output node for the user. It has its voxels before it enters the scene, where observers access it.
vtkMRMLVolumeNode* addOutput(vtkMRMLSurgicalPathScaleNode* parameters, const char* role, vtkMRMLVolumeNode* result,
                             const std::string& what)
{
  vtkMRMLScene* scene = parameters->GetScene();
  vtkMRMLNode* map = parameters->GetNodeReference(Node::TissueMapRole());
  const std::string name = (map ? map->GetName() + std::string(" ") : std::string()) + what;
  const auto node = vtkSmartPointer<vtkMRMLVolumeNode>::Take(
    vtkMRMLVolumeNode::SafeDownCast(scene->CreateNodeByClass(result->GetClassName())));
  node->SetName(scene->GenerateUniqueName(name).c_str());
  takeVoxels(node, result);
  scene->AddNode(node);
  parameters->SetNode(role, node);
  return node;
}

double countOf(const std::string& text) { return text.empty() ? -1 : std::strtod(text.c_str(), nullptr); }

} // namespace

vtkStandardNewMacro(vtkSlicerSurgicalPathScaleLogic);

//----------------------------------------------------------------------------
vtkSlicerSurgicalPathScaleLogic::vtkSlicerSurgicalPathScaleLogic() : Preview(std::make_unique<ScalePreview>())
{
  this->RunEnded->SetClientData(this);
  this->RunEnded->SetCallback([](vtkObject*, unsigned long, void* self, void*)
                              { static_cast<vtkSlicerSurgicalPathScaleLogic*>(self)->FinishRun(); });
  this->Run->AddObserver(vtkSurgicalMesherRun::CompletedEvent, this->RunEnded, 1); // before those of default priority
}

vtkSlicerSurgicalPathScaleLogic::~vtkSlicerSurgicalPathScaleLogic() { this->Run->RemoveObserver(this->RunEnded); }

void vtkSlicerSurgicalPathScaleLogic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IsPreviewShown: " << this->IsPreviewShown() << "\n";
  os << indent << "Run:\n";
  this->Run->PrintSelf(os, indent.GetNextIndent());
}

void vtkSlicerSurgicalPathScaleLogic::RegisterNodes()
{
  this->GetMRMLScene()->RegisterNodeClass(vtkSmartPointer<vtkMRMLSurgicalPathScaleNode>::New());
}

void vtkSlicerSurgicalPathScaleLogic::SetMRMLSceneInternal(vtkMRMLScene* scene)
{
  vtkNew<vtkIntArray> events;
  events->InsertNextValue(vtkMRMLScene::StartCloseEvent);
  this->SetAndObserveMRMLSceneEventsInternal(scene, events);
}

void vtkSlicerSurgicalPathScaleLogic::OnMRMLSceneStartClose()
{
  this->HidePreview();
  this->Preview->forgetTissueMap();
}

vtkMRMLSurgicalPathScaleNode* vtkSlicerSurgicalPathScaleLogic::ParameterNode()
{
  vtkMRMLScene* scene = this->GetMRMLScene();
  if (!scene) return nullptr;
  const char* className = "vtkMRMLSurgicalPathScaleNode";
  vtkMRMLNode* node = scene->GetFirstNodeByClass(className);
  if (!node) node = scene->AddNewNodeByClass(className, "Surgical Path Scale");
  return vtkMRMLSurgicalPathScaleNode::SafeDownCast(node);
}

//----------------------------------------------------------------------------
vtkSlicerSurgicalPathScaleLogic::Check
vtkSlicerSurgicalPathScaleLogic::FindProblem(vtkMRMLSurgicalPathScaleNode* parameters)
{
  if (!this->GetModuleLogic("SurgicalPathScaleCLI")) return { Problem::NoModule, TissueMapProblem::None, {} };
  const TissueMapProblem tissueMap = checkTissueMap(parameters->GetNodeReference(Node::TissueMapRole()));
  if (tissueMap != TissueMapProblem::None) return { Problem::TissueMap, tissueMap, {} };

  const auto found = [](Problem problem, const std::string& name = {}) {
    return Check{ problem, TissueMapProblem::None, name };
  };
  for (vtkMRMLMarkupsNode* node : parameters->GetPathNodes())
  {
    if (markupsPoints(node).size() == 1) return found(Problem::PathOfOnePoint, node->GetName());
  }
  const Focus focus = focusOf(parameters);
  const bool hasTarget = !focus.targets.empty();
  const bool hasPath = !focus.paths.empty();
  if (!hasTarget && !hasPath) return found(Problem::NoFocus);
  if (!hasTarget && parameters->GetCombine() == "targets") return found(Problem::NoTarget);
  if (!hasPath && parameters->GetCombine() == "path") return found(Problem::NoPath);
  if (parameters->GetMinimumEdgeLength() > parameters->GetMaximumEdgeLength()) return found(Problem::LengthsContradict);
  const std::string lengths = parameters->GetTissueLengths();
  if (!lengths.empty() && !vtksys::SystemTools::FileExists(lengths, true))
    return found(Problem::NoTissueLengths, lengths);
  if (!hasTarget && parameters->GetNullDisplacementRadius() > 0) return found(Problem::NullDisplacementTarget);
  if (!hasPath && parameters->GetNullDisplacementPathDistance() > 0) return found(Problem::NullDisplacementPath);
  try
  {
    const TissueTable names = tissueTable(parameters->GetNodeReference(Node::TissueMapRole()));
    scaleOptions(parameters, names);
    if (parameters->WantsNullDisplacement()) nullDisplacementOptions(parameters, names);
  }
  catch (const Error& error)
  {
    return found(Problem::Refused, error.what());
  }
  return {};
}

bool vtkSlicerSurgicalPathScaleLogic::Start(vtkMRMLSurgicalPathScaleNode* parameters)
{
  return this->Prepare(parameters) && this->HasStarted(this->Run->Start());
}

bool vtkSlicerSurgicalPathScaleLogic::StartAndWait(vtkMRMLSurgicalPathScaleNode* parameters)
{
  return this->Prepare(parameters) && this->HasStarted(this->Run->StartAndWait());
}

bool vtkSlicerSurgicalPathScaleLogic::HasStarted(bool isStarted)
{
  if (!isStarted) this->StartProblem = { Problem::Refused, TissueMapProblem::None, this->Run->GetErrorText() };
  return isStarted;
}

bool vtkSlicerSurgicalPathScaleLogic::Prepare(vtkMRMLSurgicalPathScaleNode* parameters)
{
  this->StartProblem = this->FindProblem(parameters);
  if (this->Run->IsBusy() || this->StartProblem.problem != Problem::None) return false;
  vtkSurgicalMesherRun* run = this->Run;
  run->SetCommandLineLogic(this->GetModuleLogic("SurgicalPathScaleCLI"));
  const TissueMapNodes map = makeTissueMapNodes(parameters->GetNodeReference(Node::TissueMapRole()));
  if (!map.labelMap)
  {
    this->StartProblem = { Problem::TissueMap, map.problem, {} };
    return false;
  }
  run->AddTemporaryNode(map.labelMap);
  run->SetParameterNode("labelMap", map.labelMap);
  if (map.colors)
  {
    run->AddTemporaryNode(map.colors);
    run->SetParameterNode("names", map.colors);
  }
  try
  {
    this->PrepareFocus(parameters);
  }
  catch (const Error& error)
  {
    this->StartProblem = { Problem::Refused, TissueMapProblem::None, error.what() };
    run->SetCommandLineLogic(nullptr); // releases the nodes
    return false;
  }
  run->SetParameter("minimumEdgeLength", parameters->GetMinimumEdgeLength());
  run->SetParameter("maximumEdgeLength", parameters->GetMaximumEdgeLength());
  run->SetParameter("childRadius", parameters->GetChildRadius());
  run->SetParameter("decayLength", parameters->GetDecayLength());
  run->SetParameter("spacing", parameters->GetSpacing());
  run->SetParameter("combine", parameters->GetCombine());
  run->SetParameter("pathChildRadius", parameters->GetPathChildRadius());
  run->SetParameter("pathDecayLength", parameters->GetPathDecayLength());
  run->SetParameter("gradation", parameters->GetGradation());
  run->SetParameter("tissueLengths", parameters->GetTissueLengths());
  this->PrepareOutputs(parameters);
  this->Parameters = parameters;
  return true;
}

/// Throws InputError if the files cannot be written.
void vtkSlicerSurgicalPathScaleLogic::PrepareFocus(vtkMRMLSurgicalPathScaleNode* parameters)
{
  const auto hand = [this](const char* parameter, const std::vector<std::vector<Vec3>>& markups)
  {
    const std::string file = this->Run->NewTemporaryFile(".mrk.json");
    writeMarkups(markups, file);
    this->Run->SetParameter(parameter, file);
  };
  const Focus focus = focusOf(parameters);
  if (!focus.targets.empty()) hand("targets", { focus.targets });
  if (!focus.paths.empty()) hand("path", focus.paths);
}

void vtkSlicerSurgicalPathScaleLogic::PrepareOutputs(vtkMRMLSurgicalPathScaleNode* parameters)
{
  this->ScaleResult = vtkSmartPointer<vtkMRMLScalarVolumeNode>::New();
  giveOneVoxel(this->ScaleResult);
  this->Run->AddTemporaryNode(this->ScaleResult);
  this->Run->SetParameterNode("scale", this->ScaleResult);
  this->LabelMapResult = nullptr;
  if (!parameters->WantsNullDisplacement()) return;
  this->LabelMapResult = vtkSmartPointer<vtkMRMLLabelMapVolumeNode>::New();
  giveOneVoxel(this->LabelMapResult);
  this->Run->AddTemporaryNode(this->LabelMapResult);
  this->Run->SetParameterNode("outputLabelMap", this->LabelMapResult);
  this->Run->SetParameter("nullDisplacementRadius", parameters->GetNullDisplacementRadius());
  this->Run->SetParameter("nullDisplacementPathDistance", parameters->GetNullDisplacementPathDistance());
  this->Run->SetParameter("nullDisplacementPathDistanceAtTarget",
                          parameters->GetNullDisplacementPathDistanceAtTarget());
  this->Run->SetParameter("nullDisplacementTissues", parameters->GetNullDisplacementTissues());
}

void vtkSlicerSurgicalPathScaleLogic::FinishRun()
{
  vtkMRMLSurgicalPathScaleNode* parameters = this->Parameters;
  if (parameters && parameters->GetScene() && this->Run->GetStatus() == vtkSurgicalMesherRun::Completed)
  {
    if (hasVoxels(this->ScaleResult)) this->FinishScale(parameters);
    if (hasVoxels(this->LabelMapResult)) this->FinishLabelMap(parameters);
  }
  this->ScaleResult = nullptr;
  this->LabelMapResult = nullptr;
}

void vtkSlicerSurgicalPathScaleLogic::FinishScale(vtkMRMLSurgicalPathScaleNode* parameters)
{
  vtkMRMLVolumeNode* volume = parameters->GetScalarVolumeNode(Node::ScaleRole());
  if (volume) takeVoxels(volume, this->ScaleResult);
  else
    volume = addOutput(parameters, Node::ScaleRole(), this->ScaleResult,
                       vtkMRMLTr("vtkSlicerSurgicalPathScaleLogic", "edge lengths"));
  volume->CreateDefaultDisplayNodes();
  double range[2];
  volume->GetImageData()->GetScalarRange(range);
  setScaleColors(parameters->GetScalarVolumeNode(Node::ScaleRole()), range[0], range[1]);
}

/// The file written by the CLI module has names and colours, but Slicer reads them from segmentations only.
void vtkSlicerSurgicalPathScaleLogic::FinishLabelMap(vtkMRMLSurgicalPathScaleNode* parameters)
{
  if (parameters->GetLabelMapNode(Node::OutputLabelMapRole()))
    takeVoxels(parameters->GetLabelMapNode(Node::OutputLabelMapRole()), this->LabelMapResult);
  else
    addOutput(parameters, Node::OutputLabelMapRole(), this->LabelMapResult,
              vtkMRMLTr("vtkSlicerSurgicalPathScaleLogic", "null displacement"));
  vtkMRMLLabelMapVolumeNode* labelMap = parameters->GetLabelMapNode(Node::OutputLabelMapRole());
  TissueTable table = tissueTable(parameters->GetNodeReference(Node::TissueMapRole()));
  try
  {
    const TissueMap& before = this->Preview->tissueMap(parameters->GetNodeReference(Node::TissueMapRole()));
    const std::vector<Label> old = presentLabels(before);
    const std::vector<Label> now = presentLabels(readTissueMap(labelMap));
    for (Label label : now)
    {
      if (std::binary_search(old.begin(), old.end(), label)) continue;
      table[label] = Tissue{ "null displacement", { 0.45, 0.55, 0.75 } };
      table[label].isNullDisplacement = true;
    }
  }
  catch (const Error&)
  {
    // The input has been removed or changed meanwhile: the known names must do.
  }
  keepNullDisplacement(labelMap, table);
  showTissueColors(labelMap, table);
}

void vtkSlicerSurgicalPathScaleLogic::ShowResult(vtkMRMLSurgicalPathScaleNode* parameters)
{
  this->HidePreview();
  if (parameters->GetScalarVolumeNode(Node::ScaleRole()))
    showInSliceViews(parameters->GetScalarVolumeNode(Node::ScaleRole()));
}

//----------------------------------------------------------------------------
vtkSlicerSurgicalPathScaleLogic::Estimate vtkSlicerSurgicalPathScaleLogic::GetEstimateOfRun() const
{
  return { countOf(this->Run->GetReturnedValue("estimatedTriangles")),
           countOf(this->Run->GetReturnedValue("estimatedTetrahedra")) };
}

vtkSlicerSurgicalPathScaleLogic::Estimate
vtkSlicerSurgicalPathScaleLogic::EstimateMesh(vtkMRMLSurgicalPathScaleNode* parameters)
{
  if (this->FindProblem(parameters).problem != Problem::None) return {};
  try
  {
    const MeshSizeEstimate estimate = this->Preview->estimate(parameters);
    return { estimate.triangles, estimate.tetrahedra };
  }
  catch (const Error&)
  {
    return {}; // the run will report the error
  }
}

bool vtkSlicerSurgicalPathScaleLogic::ShowPreview(vtkMRMLSurgicalPathScaleNode* parameters)
{
  if (this->FindProblem(parameters).problem == Problem::None)
  {
    try
    {
      this->Preview->show(parameters);
      return true;
    }
    catch (const Error&)
    {
      // There is nothing to show; the run will report the error.
    }
  }
  this->HidePreview();
  return false;
}

void vtkSlicerSurgicalPathScaleLogic::HidePreview() { this->Preview->hide(); }

void vtkSlicerSurgicalPathScaleLogic::ReleaseTissueMap() { this->Preview->forgetTissueMap(); }

bool vtkSlicerSurgicalPathScaleLogic::IsPreviewShown() const { return this->Preview->isShown(); }

vtkMRMLScalarVolumeNode* vtkSlicerSurgicalPathScaleLogic::GetPreviewScaleNode() const
{
  return this->Preview->scaleNode();
}

vtkMRMLLabelMapVolumeNode* vtkSlicerSurgicalPathScaleLogic::GetPreviewNullDisplacementNode() const
{
  return this->Preview->nullDisplacementNode();
}
