// SPDX-License-Identifier: Apache-2.0
#include "vtkSlicerSimplexMesherLogic.h"

#include "Errors.h"
#include "HostDifferences.h"
#include "ReportTables.h"
#include "RunNodes.h"
#include "SceneNodes.h"
#include "Text.h"
#include "TissueColors.h"
#include "TissueModels.h"
#include "VolumeNodes.h"
#include "vtkMRMLSimplexMesherNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTableNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>
#include <array>

using namespace surgicalmesher;

namespace
{

using Node = vtkMRMLSimplexMesherNode;
using Problem = vtkSlicerSimplexMesherLogic::Problem;
using Check = vtkSlicerSimplexMesherLogic::Check;

/// Whether the volume of `scale`, up to the outer faces of its voxels, contains that of `map`, as requireCover()
/// demands.
bool covers(vtkMRMLVolumeNode* scale, vtkMRMLVolumeNode* map)
{
  vtkNew<vtkMatrix4x4> toScale;
  vtkMatrix4x4::Invert(voxelsToWorld(scale), toScale);
  vtkMatrix4x4::Multiply4x4(toScale, voxelsToWorld(map), toScale);
  const int* mapSize = map->GetImageData()->GetDimensions();
  const std::array<int, 3> mapVoxels{ mapSize[0], mapSize[1], mapSize[2] };
  const int* scaleSize = scale->GetImageData()->GetDimensions();
  for (int corner = 0; corner < 8; ++corner)
  {
    double p[4] = { -0.5, -0.5, -0.5, 1 };
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((corner >> axis) & 1) p[axis] = mapVoxels[axis] - 0.5;
    }
    toScale->MultiplyPoint(p, p);
    for (int axis = 0; axis < 3; ++axis)
    {
      constexpr double tolerance = 1e-3; // in voxels
      if (p[axis] < -0.5 - tolerance || p[axis] > scaleSize[axis] - 0.5 + tolerance) return false;
    }
  }
  return true;
}

/// The voxel grid of a segmentation, or of a map to be resampled, is known only after its export: SimplexMesherCLI
/// checks it then.
Problem scaleProblem(Node* parameters)
{
  if (!parameters->GetUseScale()) return parameters->GetEdgeLength() > 0 ? Problem::None : Problem::NoEdgeLength;
  vtkMRMLScalarVolumeNode* scale = parameters->GetScalarVolumeNode(Node::ScaleRole());
  if (!hasVoxels(scale)) return Problem::NoScale;
  if (isUnderWarp(scale)) return Problem::ScaleWarped;
  auto* map = vtkMRMLLabelMapVolumeNode::SafeDownCast(parameters->GetNodeReference(Node::TissueMapRole()));
  return !map || isUnderWarp(map) || covers(scale, map) ? Problem::None : Problem::ScaleTooSmall;
}

Problem lengthProblem(const TissueSetting& setting)
{
  const double minimum = setting.minimumEdgeLength;
  const double maximum = setting.maximumEdgeLength;
  if (setting.role == TissueRole::Leave || !(minimum > 0 && maximum > 0)) return Problem::None;
  if (minimum > maximum) return Problem::LengthsContradict;
  const bool differ = setting.role == TissueRole::Shell && minimum < maximum;
  return differ ? Problem::LengthsOfShellDiffer : Problem::None;
}

/// Checks what SimplexMesherCLI would refuse.
Problem proximityProblem(Node* parameters)
{
  const double near = parameters->GetProximityNear();
  const double far = parameters->GetProximityFar();
  return (near == 0 && far == 0) || (near > 0 && near <= far) ? Problem::None : Problem::ProximityUnfit;
}

Check surroundingsProblem(Node* parameters, const std::vector<TissueRow>& tissues)
{
  Check check;
  for (const TissueRow& tissue : tissues)
  {
    if (tissue.label != Label(parameters->GetBackground()) || tissue.voxels == 0) continue;
    check.problem = Problem::LabelTaken;
    check.tissue = tissue;
  }
  return check;
}

Check tissueProblem(Node* parameters, const std::vector<TissueRow>& tissues)
{
  Check check;
  bool isAnyMeshed = false;
  for (const TissueRow& tissue : tissues)
  {
    const TissueSetting setting = parameters->GetTissueSetting(tissue.id);
    isAnyMeshed = isAnyMeshed || (setting.role != TissueRole::Leave && tissue.voxels != 0);
    check.problem = lengthProblem(setting);
    check.tissue = tissue;
    if (check.problem != Problem::None) return check;
  }
  check.problem = isAnyMeshed || tissues.empty() ? Problem::None : Problem::NothingToMesh;
  return check;
}

Check surfaceProblem(Node* parameters, const std::vector<TissueRow>& tissues)
{
  Check check = tissueProblem(parameters, tissues);
  if (check.problem == Problem::None) check = surroundingsProblem(parameters, tissues);
  if (check.problem == Problem::None && !tissues.empty()) check.problem = proximityProblem(parameters);
  return check;
}

/// Slicer's writer of tables cannot write double quotes.
std::string withoutQuotes(std::string text)
{
  std::replace(text.begin(), text.end(), '"', '\'');
  return text;
}

std::string roleText(const TissueSetting& setting)
{
  switch (setting.role)
  {
  case TissueRole::Group: return "group " + withoutQuotes(setting.group);
  case TissueRole::Shell: return "shell";
  case TissueRole::Leave: return "leave";
  default: return "mesh";
  }
}

/// Returns an empty text for an open value.
std::string numberText(double value, bool isOpen) { return isOpen ? std::string() : text::rounded(value, 17); }

/// Returns the input of --tissues: a row for every tissue of the map with settings; null if there is none.
/// SimplexMesherCLI refuses tissues without voxels, so they are left out.
vtkSmartPointer<vtkMRMLTableNode> settingsTable(Node* parameters, const std::vector<TissueRow>& tissues,
                                                vtkImageData* exported)
{
  const std::array<const char*, 7> names{ "label", "role", "minimum", "maximum", "protected", "islands", "cavities" };
  std::array<vtkNew<vtkStringArray>, 7> columns;
  const std::map<Label, std::int64_t> present = countVoxels(exported);
  for (const TissueRow& tissue : tissues)
  {
    if (parameters->GetTissueSettings().count(tissue.id) == 0 || present.count(tissue.label) == 0) continue;
    const TissueSetting s = parameters->GetTissueSetting(tissue.id);
    const std::array<std::string, 7> fields{ std::to_string(tissue.label),
                                             roleText(s),
                                             numberText(s.minimumEdgeLength, s.minimumEdgeLength == 0),
                                             numberText(s.maximumEdgeLength, s.maximumEdgeLength == 0),
                                             s.isProtected ? "yes" : "no",
                                             numberText(s.islandVolume, s.islandVolume < 0),
                                             numberText(s.cavityVolume, s.cavityVolume < 0) };
    for (std::size_t i = 0; i < fields.size(); ++i) columns[i]->InsertNextValue(fields[i]);
  }
  if (columns[0]->GetNumberOfValues() == 0) return nullptr;
  auto node = vtkSmartPointer<vtkMRMLTableNode>::New();
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    columns[i]->SetName(names[i]);
    node->GetTable()->AddColumn(columns[i]);
  }
  return node;
}

/// Ambient tetrahedra are kept for the volume stage only and not displayed: there are millions on both sides of every
/// surface.
vtkMRMLModelNode* ambientNode(vtkMRMLModelNode* surface, vtkSurgicalMesherRun* run)
{
  const std::string name = surface->GetName() + (" " + vtkMRMLTr("SimplexMesher", "ambient tetrahedra"));
  auto* node = vtkMRMLModelNode::SafeDownCast(surface->GetNodeReference(Node::AmbientTetrahedraRole()));
  node = outputModel(node, surface->GetScene(), name, run);
  surface->SetNodeReferenceID(Node::AmbientTetrahedraRole(), node->GetID());
  node->SetHideFromEditors(true);
  node->CreateDefaultDisplayNodes();
  node->SetDisplayVisibility(false);
  return node;
}

/// Returns a node referenced by the parameter node, created on first use.
template <class Wanted>
Wanted* ownNode(Node* parameters, const char* role, const std::string& name)
{
  auto* node = Wanted::SafeDownCast(parameters->GetNodeReference(role));
  if (node) return node;
  vtkNew<Wanted> fresh;
  vtkMRMLScene* scene = parameters->GetScene();
  node = Wanted::SafeDownCast(scene->AddNewNodeByClass(fresh->GetClassName(), unusedName(scene, name)));
  parameters->SetNode(role, node);
  return node;
}

} // namespace

vtkStandardNewMacro(vtkSlicerSimplexMesherLogic);

vtkSlicerSimplexMesherLogic::vtkSlicerSimplexMesherLogic()
{
  this->RunEnded->SetClientData(this);
  this->RunEnded->SetCallback([](vtkObject*, unsigned long, void* self, void*)
                              { static_cast<vtkSlicerSimplexMesherLogic*>(self)->FinishRun(); });
  this->Run->AddObserver(vtkSurgicalMesherRun::CompletedEvent, this->RunEnded, 1); // before those of default priority
}

vtkSlicerSimplexMesherLogic::~vtkSlicerSimplexMesherLogic() { this->Run->RemoveObserver(this->RunEnded); }

void vtkSlicerSimplexMesherLogic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Run:\n";
  this->Run->PrintSelf(os, indent.GetNextIndent());
}

void vtkSlicerSimplexMesherLogic::RegisterNodes()
{
  this->GetMRMLScene()->RegisterNodeClass(vtkSmartPointer<vtkMRMLSimplexMesherNode>::New());
}

vtkMRMLSimplexMesherNode* vtkSlicerSimplexMesherLogic::ParameterNode()
{
  vtkMRMLScene* scene = this->GetMRMLScene();
  if (!scene) return nullptr;
  vtkMRMLNode* node = scene->GetFirstNodeByClass("vtkMRMLSimplexMesherNode");
  return Node::SafeDownCast(node ? node : scene->AddNewNodeByClass("vtkMRMLSimplexMesherNode", "SimplexMesher"));
}

Check vtkSlicerSimplexMesherLogic::FindProblem(vtkMRMLSimplexMesherNode* parameters,
                                               const std::vector<TissueRow>& tissues)
{
  Check check;
  check.tissueMap = checkTissueMap(parameters->GetNodeReference(Node::TissueMapRole()));
  if (!this->GetModuleLogic("SimplexMesherCLI")) check.problem = Problem::NoModule;
  else if (check.tissueMap != TissueMapProblem::None) check.problem = Problem::TissueMap;
  else check.problem = scaleProblem(parameters);
  return check.problem == Problem::None ? surfaceProblem(parameters, tissues) : check;
}

void vtkSlicerSimplexMesherLogic::SetMRMLSceneInternal(vtkMRMLScene* scene)
{
  vtkNew<vtkIntArray> events;
  events->InsertNextValue(vtkMRMLScene::NodeRemovedEvent);
  this->SetAndObserveMRMLSceneEventsInternal(scene, events);
}

/// A hidden node can be removed by nobody else, and the results of a run cannot be finished without its parameters.
void vtkSlicerSimplexMesherLogic::OnMRMLSceneNodeRemoved(vtkMRMLNode* node)
{
  if (node == this->Parameters) this->Run->Cancel();
  if (!node->IsA("vtkMRMLModelNode") || this->GetMRMLScene()->IsClosing()) return;
  const char* ambient = node->GetNodeReferenceID(Node::AmbientTetrahedraRole());
  removeFromScene(ambient ? this->GetMRMLScene()->GetNodeByID(ambient) : nullptr);
}

bool vtkSlicerSimplexMesherLogic::Start(vtkMRMLSimplexMesherNode* parameters)
{
  return this->Prepare(parameters) && this->Run->Start();
}

bool vtkSlicerSimplexMesherLogic::StartAndWait(vtkMRMLSimplexMesherNode* parameters)
{
  return this->Prepare(parameters) && this->Run->StartAndWait();
}

bool vtkSlicerSimplexMesherLogic::Prepare(vtkMRMLSimplexMesherNode* parameters)
{
  if (this->Run->IsBusy()) return false;
  vtkMRMLNode* tissueMap = parameters->GetNodeReference(Node::TissueMapRole());
  const std::vector<TissueRow> tissues = listTissues(tissueMap);
  if (this->FindProblem(parameters, tissues).problem != Problem::None) return false;
  const TissueMapNodes map = makeTissueMapNodes(tissueMap);
  if (map.problem != TissueMapProblem::None) return false;

  this->Run->SetCommandLineLogic(this->GetModuleLogic("SimplexMesherCLI"));
  const auto setInput = [&](const char* name, vtkMRMLNode* node)
  {
    if (!node) return;
    this->Run->AddTemporaryNode(node);
    this->Run->SetParameterNode(name, node);
  };
  setInput("labelMap", map.labelMap);
  setInput("names", map.colors);
  this->Run->SetParameter("nullDisplacementLabels", nullDisplacementLabels(tissueTable(tissueMap)));
  setInput("tissues", settingsTable(parameters, tissues, map.labelMap->GetImageData()));
  if (parameters->GetUseScale()) setInput("scale", copyForRun(parameters->GetScalarVolumeNode(Node::ScaleRole())));
  else this->Run->SetParameter("edgeLength", parameters->GetEdgeLength());
  this->PrepareOptions(parameters);
  this->PrepareOutputs(parameters);
  this->Parameters = parameters;
  return true;
}

void vtkSlicerSimplexMesherLogic::PrepareOptions(vtkMRMLSimplexMesherNode* parameters)
{
  this->Run->SetParameter("minimumIslandVolume", parameters->GetMinimumIslandVolume());
  this->Run->SetParameter("minimumCavityVolume", parameters->GetMinimumCavityVolume());
  this->Run->SetParameter("featureScale", parameters->GetFeatureScale());
  this->Run->SetParameter("smoothing", parameters->GetSmoothing());
  this->Run->SetParameter("rigidity", parameters->GetRigidity());
  this->Run->SetParameter("continuity", parameters->GetContinuity());
  this->Run->SetParameter("maximumDistance", parameters->GetMaximumDistance());
  this->Run->SetParameter("proximity", text::rounded(parameters->GetProximityNear(), 17) + "," +
                                         text::rounded(parameters->GetProximityFar(), 17));
  this->Run->SetParameter("followThickness", parameters->GetFollowThickness());
  this->Run->SetParameter("chordError", parameters->GetChordError());
  this->Run->SetParameter("gradation", parameters->GetGradation());
  this->Run->SetParameter("background", parameters->GetBackground());
  this->Run->SetParameter("threads", parameters->GetThreads());
}

void vtkSlicerSimplexMesherLogic::PrepareOutputs(vtkMRMLSimplexMesherNode* parameters)
{
  const std::string name =
    parameters->GetNodeReference(Node::TissueMapRole())->GetName() + (" " + vtkMRMLTr("SimplexMesher", "surface"));
  vtkMRMLModelNode* surface =
    outputModel(parameters->GetModelNode(Node::SurfaceRole()), parameters->GetScene(), name, this->Run);
  this->Surface = surface;
  this->Run->SetParameterNode("surface", surface);
  if (parameters->GetKeepAmbient()) this->Run->SetParameterNode("ambient", ambientNode(surface, this->Run));
  if (vtkMRMLModelNode* mesh = parameters->GetModelNode(Node::SimplexMeshRole()))
    this->Run->SetParameterNode("simplexMesh", outputModel(mesh, parameters->GetScene(), {}, this->Run));
  this->Volumes.clear();
  this->PrepareVolume("preparedLabelMap", parameters->GetLabelMapNode(Node::PreparedLabelMapRole()));
  this->PrepareVolume("followedScale", parameters->GetScalarVolumeNode(Node::FollowedScaleRole()));
  this->ReportFile = parameters->GetReport() ? this->Run->NewTemporaryFile(".json") : std::string();
  if (!this->ReportFile.empty()) this->Run->SetParameter("report", this->ReportFile);
}

void vtkSlicerSimplexMesherLogic::PrepareVolume(const char* parameter, vtkMRMLVolumeNode* chosen)
{
  if (!chosen) return;
  const auto result =
    vtkSmartPointer<vtkMRMLVolumeNode>::Take(vtkMRMLVolumeNode::SafeDownCast(chosen->CreateNodeInstance()));
  result->SetName(chosen->GetName());
  giveOneVoxel(result);
  this->Run->AddTemporaryNode(result);
  this->Run->SetParameterNode(parameter, result);
  this->Volumes.emplace_back(chosen, result);
}

void vtkSlicerSimplexMesherLogic::FinishRun()
{
  vtkMRMLSimplexMesherNode* parameters = this->Parameters;
  vtkMRMLModelNode* surface = this->Surface;
  if (!surface || !surface->GetScene() || !parameters || !parameters->GetScene()) return;
  if (this->Run->GetStatus() == vtkSurgicalMesherRun::Completed && surface->GetPolyData())
  {
    const int wasModifying = parameters->StartModify();
    parameters->SetNode(Node::SurfaceRole(), surface);
    this->FinishVolumes();
    this->FinishSurface(surface);
    if (!this->ReportFile.empty()) this->FinishReport(surface);
    parameters->EndModify(wasModifying);
  }
  else if (!surface->GetNodeReference(Node::AmbientTetrahedraRole())) // it was removed with the run
  {
    surface->SetNodeReferenceID(Node::AmbientTetrahedraRole(), nullptr);
  }
}

void vtkSlicerSimplexMesherLogic::FinishVolumes()
{
  for (const auto& [chosen, result] : this->Volumes)
  {
    if (!chosen || !chosen->GetScene() || !hasVoxels(result)) continue;
    takeVoxels(chosen, result);
    chosen->CreateDefaultDisplayNodes();
  }
  this->Volumes.clear();
}

void vtkSlicerSimplexMesherLogic::FinishSurface(vtkMRMLModelNode* surface)
{
  vtkMRMLColorTableNode* colors = showTissueColors(surface, "BoundaryLabels"); // by the higher of the two labels
  vtkMRMLLabelMapVolumeNode* prepared = this->Parameters->GetLabelMapNode(Node::PreparedLabelMapRole());
  if (prepared && prepared->GetDisplayNode()) prepared->GetDisplayNode()->SetAndObserveColorNodeID(colors->GetID());
  if (vtkMRMLModelNode* mesh = this->Parameters->GetModelNode(Node::SimplexMeshRole()))
    showTissueColors(mesh, "TissueLabel");
  // Tetrahedra of an earlier surface would mislead the volume stage.
  if (!this->Parameters->GetKeepAmbient()) removeFromScene(surface->GetNodeReference(Node::AmbientTetrahedraRole()));
  if (this->Parameters->GetTissueModels()) makeTissueModels(surface);
  else removeTissueModels(surface);
  surface->SetDisplayVisibility(!this->Parameters->GetTissueModels()); // coincident triangles would flicker
}

void vtkSlicerSimplexMesherLogic::FinishReport(vtkMRMLModelNode* surface)
{
  const auto table = [&](const char* role, const std::string& what)
  { return ownNode<vtkMRMLTableNode>(this->Parameters, role, surface->GetName() + (": " + what)); };
  try
  {
    fillTissueTable(this->ReportFile, surface, table(Node::TissueTableRole(), vtkMRMLTr("SimplexMesher", "tissues")));
    fillShapeTable(this->ReportFile,
                   table(Node::ShapeTableRole(), vtkMRMLTr("SimplexMesher", "roughness, folds and ears")));
    fillFoldTable(this->ReportFile, surface, table(Node::FoldTableRole(), vtkMRMLTr("SimplexMesher", "longest folds")));
    fillEarTable(this->ReportFile, surface, table(Node::EarTableRole(), vtkMRMLTr("SimplexMesher", "largest ears")));
    vtkMRMLTableNode* evolution = table(Node::EvolutionTableRole(), vtkMRMLTr("SimplexMesher", "evolution"));
    fillEvolutionTable(this->ReportFile, evolution);
    std::vector<vtkMRMLPlotChartNode*> charts;
    for (int i = 0; i < this->Parameters->GetNumberOfNodeReferences(Node::EvolutionChartRole()); ++i)
    {
      vtkMRMLNode* chart = this->Parameters->GetNthNodeReference(Node::EvolutionChartRole(), i);
      if (chart) charts.push_back(vtkMRMLPlotChartNode::SafeDownCast(chart));
    }
    charts = plotEvolution(evolution, charts);
    this->Parameters->RemoveNodeReferenceIDs(Node::EvolutionChartRole());
    for (vtkMRMLPlotChartNode* chart : charts)
      this->Parameters->AddNodeReferenceID(Node::EvolutionChartRole(), chart->GetID());
  }
  catch (const InputError& error)
  {
    vtkErrorMacro("The report could not be read: " << error.what());
  }
}
