// SPDX-License-Identifier: Apache-2.0
#include "vtkSlicerFuchsTetrahedralizerLogic.h"

#include "CurvedSides.h"
#include "Errors.h"
#include "Export.h"
#include "HostDifferences.h"
#include "MarkupsInput.h"
#include "MaterialTable.h"
#include "MeshDisplay.h"
#include "MeshReport.h"
#include "ModelMesh.h"
#include "OutputFiles.h"
#include "RunCheck.h"
#include "RunInputs.h"
#include "SecondOrder.h"
#include "ShellChoices.h"
#include "Units.h"
#include "VolumeNodes.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSliceNode.h>
#include <vtkMRMLTableNode.h>

#include <vtkCallbackCommand.h>
#include <vtkFieldData.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtksys/SystemTools.hxx>

#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <utility>

using namespace surgicalmesher;
using Parameters = vtkMRMLFuchsTetrahedralizerNode;
using Problem = vtkSlicerFuchsTetrahedralizerLogic::Problem;
using Check = vtkSlicerFuchsTetrahedralizerLogic::Check;

namespace
{

FiniteElementOptions optionsOf(Parameters* parameters, const TissueTable& tissues, const std::set<Label>& present)
{
  FiniteElementOptions options;
  if (!parameters->GetMaterialsFile().empty())
    options.materials = readMaterialTable(parameters->GetMaterialsFile(), tissues, present);
  options.shells = shellChoices(shellTextsOf(parameters), tissues, present, parameters->GetShellThickness());
  return options;
}

/// Returns the model with the elements and units chosen for export.
FiniteElementModel asExported(FiniteElementModel model, Parameters* parameters)
{
  const int elements = parameters->GetExportElements();
  if (elements != Parameters::FourNodes) model = withMidSideNodes(std::move(model));
  if (elements == Parameters::TenNodesCurved) model = withCurvedSides(std::move(model));
  const bool isSI = parameters->GetExportUnits() == Parameters::SI;
  return inUnits(std::move(model), isSI ? Units::SI : Units::Millimetres);
}

// ---- nodes for a run ------------------------------------------------------------------------------------------------

vtkSmartPointer<vtkMRMLModelNode> hiddenModel(vtkPointSet* mesh, const std::string& name)
{
  auto model = vtkSmartPointer<vtkMRMLModelNode>::New();
  model->SetName(name.c_str());
  model->SetAndObserveMesh(mesh);
  return model;
}

std::string contentOf(const std::string& file)
{
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

/// Returns the error thrown by `action`; empty if there was none.
std::string failureOf(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return {};
}

} // namespace

struct vtkSlicerFuchsTetrahedralizerLogic::AmbientCheck
{
  vtkPointSet* surface = nullptr;
  vtkPointSet* ambient = nullptr;
  vtkMTimeType surfaceTime = 0;
  vtkMTimeType ambientTime = 0;
  bool belong = false;

  bool operator()(vtkMRMLModelNode* surfaceNode, vtkMRMLModelNode* ambientNode)
  {
    vtkPointSet *s = surfaceNode->GetMesh(), *a = ambientNode->GetMesh();
    if (s == surface && a == ambient && s->GetMTime() == surfaceTime && a->GetMTime() == ambientTime) return belong;
    belong = belongTogether(surfaceNode, ambientNode);
    surface = s;
    ambient = a;
    surfaceTime = s->GetMTime();
    ambientTime = a->GetMTime();
    return belong;
  }
};

vtkStandardNewMacro(vtkSlicerFuchsTetrahedralizerLogic);

vtkSlicerFuchsTetrahedralizerLogic::vtkSlicerFuchsTetrahedralizerLogic() : LastAmbientCheck(new AmbientCheck)
{
  this->RunEvents->SetClientData(this);
  this->RunEvents->SetCallback([](vtkObject*, unsigned long event, void* self, void*)
                               { static_cast<vtkSlicerFuchsTetrahedralizerLogic*>(self)->OnRunEvent(event); });
  constexpr float beforeOthers = 10;
  this->Run->AddObserver(vtkSurgicalMesherRun::StatusChangedEvent, this->RunEvents, beforeOthers);
  this->Run->AddObserver(vtkSurgicalMesherRun::CompletedEvent, this->RunEvents, beforeOthers);
}

vtkSlicerFuchsTetrahedralizerLogic::~vtkSlicerFuchsTetrahedralizerLogic()
{
  this->Run->RemoveObserver(this->RunEvents);
  delete this->LastAmbientCheck;
}

void vtkSlicerFuchsTetrahedralizerLogic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Run:\n";
  this->Run->PrintSelf(os, indent.GetNextIndent());
}

void vtkSlicerFuchsTetrahedralizerLogic::RegisterNodes()
{
  this->GetMRMLScene()->RegisterNodeClass(vtkSmartPointer<vtkMRMLFuchsTetrahedralizerNode>::New());
}

vtkMRMLFuchsTetrahedralizerNode* vtkSlicerFuchsTetrahedralizerLogic::ParameterNode()
{
  vtkMRMLScene* scene = this->GetMRMLScene();
  if (!scene) return nullptr;
  vtkMRMLNode* node = scene->GetFirstNodeByClass("vtkMRMLFuchsTetrahedralizerNode");
  if (!node) node = scene->AddNewNodeByClass("vtkMRMLFuchsTetrahedralizerNode");
  return vtkMRMLFuchsTetrahedralizerNode::SafeDownCast(node);
}

// ---- before a run ---------------------------------------------------------------------------------------------------

Check vtkSlicerFuchsTetrahedralizerLogic::FindProblem(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  const Check check = findProblem(parameters, *this->LastAmbientCheck);
  if (check.problem == Problem::None && !this->GetModuleLogic("FuchsTetrahedralizerCLI"))
    return { Problem::NoModule, nullptr, {} };
  return check;
}

vtkSlicerFuchsTetrahedralizerLogic::Surface
vtkSlicerFuchsTetrahedralizerLogic::DescribeSurface(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  const std::vector<vtkMRMLModelNode*> surfaces = surfacesOf(parameters);
  Surface result;
  for (vtkMRMLModelNode* surface : surfaces)
  {
    if (surface->GetPolyData()) result.triangles += surface->GetPolyData()->GetNumberOfPolys();
  }
  result.hasTargetLengths = hasTargetLengths(surfaces);
  result.isLabelled = surfaces.size() == 1 && isLabelledSurface(surfaces.front());
  if (result.isLabelled) result.tissues = int(tissuesOfSurface(surfaces.front()).size());
  result.ambient = ambientOf(surfaces);
  return result;
}

std::vector<vtkMRMLModelNode*> vtkSlicerFuchsTetrahedralizerLogic::LabelledSurfaces()
{
  std::vector<vtkMRMLModelNode*> surfaces;
  std::vector<vtkMRMLNode*> models;
  if (this->GetMRMLScene()) this->GetMRMLScene()->GetNodesByClass("vtkMRMLModelNode", models);
  for (vtkMRMLNode* node : models)
  {
    auto* model = vtkMRMLModelNode::SafeDownCast(node);
    if (!model->GetHideFromEditors() && isLabelledSurface(model)) surfaces.push_back(model);
  }
  return surfaces;
}

// ---- runs -----------------------------------------------------------------------------------------------------------

bool vtkSlicerFuchsTetrahedralizerLogic::Start(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  return this->Prepare(parameters) && this->Run->Start();
}

bool vtkSlicerFuchsTetrahedralizerLogic::StartAndWait(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  return this->Prepare(parameters) && this->Run->StartAndWait();
}

bool vtkSlicerFuchsTetrahedralizerLogic::Prepare(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  if (this->Run->IsBusy() || this->FindProblem(parameters).problem != Problem::None) return false;
  this->Run->SetCommandLineLogic(this->GetModuleLogic("FuchsTetrahedralizerCLI"));
  this->Parameters = parameters;
  this->PrepareSurface(parameters);
  this->PrepareLengths(parameters);
  const std::string failure = failureOf([&] { this->PrepareConstitutiveClasses(parameters); });
  if (!failure.empty())
  {
    this->Run->SetCommandLineLogic(nullptr); // releases the nodes
    this->Run->SetErrorText(failure);
    return false;
  }
  this->PrepareOutputs(parameters);
  this->Run->SetParameter("materials", parameters->GetMaterialsFile());
  this->Run->SetParameter("shellThickness", parameters->GetShellThickness());
  if (parameters->GetModelNode(Parameters::ShellsRole()))
    this->Run->SetParameter("shell", parameters->GetShellTissues());
  this->Run->SetParameter("conditioning", parameters->GetConditioning());
  this->Run->SetParameter("featureAngle", parameters->GetFeatureAngle());
  this->Run->SetParameter("threads", parameters->GetThreads());
  return true;
}

void vtkSlicerFuchsTetrahedralizerLogic::PrepareSurface(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  const std::vector<vtkMRMLModelNode*> surfaces = surfacesOf(parameters);
  const auto surface = hiddenModel(surfaceInWorld(surfaces), surfaces.front()->GetName());
  this->Run->AddTemporaryNode(surface);
  this->Run->SetParameterNode("surface", surface);
  vtkMRMLModelNode* ambient = ambientOf(surfaces);
  if (!ambient || !parameters->GetUseAmbient()) return;
  const auto copy = hiddenModel(ambientInWorld(ambient, surfaces.front()), ambient->GetName());
  this->Run->AddTemporaryNode(copy);
  this->Run->SetParameterNode("ambient", copy);
}

void vtkSlicerFuchsTetrahedralizerLogic::PrepareLengths(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  if (parameters->GetEdgeLengthSource() == Parameters::Uniform)
    this->Run->SetParameter("edgeLength", parameters->GetEdgeLength());
  if (parameters->GetEdgeLengthSource() != Parameters::FromScale) return;
  const auto scale = copyForRun(scaleOf(parameters));
  this->Run->AddTemporaryNode(scale);
  this->Run->SetParameterNode("scale", scale);
}

void vtkSlicerFuchsTetrahedralizerLogic::PrepareConstitutiveClasses(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  const ConstitutiveRule rule = ruleOf(parameters);
  const auto fileOf = [this](const std::vector<Path>& markups)
  {
    const std::string file = this->Run->NewTemporaryFile(".mrk.json");
    writeMarkups(markups, file);
    return file;
  };
  if (!rule.targets.empty()) this->Run->SetParameter("targets", fileOf({ rule.targets }));
  if (!rule.paths.empty()) this->Run->SetParameter("path", fileOf(rule.paths));
  this->Run->SetParameter("nonlinearDistance", rule.nonlinearDistance);
  this->Run->SetParameter("nonlinearDistanceAtTarget", rule.nonlinearDistanceAtTarget);
  this->Run->SetParameter("nullDisplacementRadius", rule.nullTargetRadius);
  this->Run->SetParameter("nullDisplacementPathDistance", rule.nullPathDistance);
  this->Run->SetParameter("nullDisplacementPathDistanceAtTarget", rule.nullPathDistanceAtTarget);
}

/// Slicer fills separate nodes, so that the user's nodes get all results of a run or none.
void vtkSlicerFuchsTetrahedralizerLogic::PrepareOutputs(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  this->Results.clear();
  for (const std::string role : outputRoles)
  {
    if (role != Parameters::MeshRole() && !parameters->GetModelNode(role.c_str())) continue;
    const auto result = vtkSmartPointer<vtkMRMLModelNode>::New();
    result->SetName(role.c_str());
    this->Run->AddTemporaryNode(result);
    this->Run->SetParameterNode(role, result);
    this->Results[role] = result;
  }
  this->ReportFile = this->Run->NewTemporaryFile(".json");
  this->Run->SetParameter("report", this->ReportFile);
  this->OffendingTrianglesFile = this->Run->NewTemporaryFile(".vtp");
  this->Run->SetParameter("offendingTriangles", this->OffendingTrianglesFile);
}

void vtkSlicerFuchsTetrahedralizerLogic::OnRunEvent(unsigned long event)
{
  const vtkSurgicalMesherRun::Status status = this->Run->GetStatus();
  if (event == vtkSurgicalMesherRun::StatusChangedEvent && status == vtkSurgicalMesherRun::Failed)
    this->ShowTrianglesAtFault();
  if (event == vtkSurgicalMesherRun::CompletedEvent && status == vtkSurgicalMesherRun::Completed) this->FinishRun();
}

/// Shows the triangles for which the surface was refused, if that is why the module failed.
void vtkSlicerFuchsTetrahedralizerLogic::ShowTrianglesAtFault()
{
  if (!this->GetMRMLScene() || vtksys::SystemTools::FileLength(this->OffendingTrianglesFile) == 0) return;
  const std::string failure = failureOf(
    [&]
    {
      auto* model = vtkMRMLModelNode::SafeDownCast(this->GetMRMLScene()->AddNewNodeByClass(
        "vtkMRMLModelNode", vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "Triangles at fault")));
      model->SetAndObserveMesh(polyDataOf(readSurface(this->OffendingTrianglesFile).surface));
      model->CreateDefaultDisplayNodes();
      model->GetDisplayNode()->SetColor(0.84, 0.10, 0.11);
      model->GetDisplayNode()->SetEdgeVisibility(true);
      model->GetDisplayNode()->SetLineWidth(3);
      this->Run->SetErrorText(this->Run->GetErrorText() + "; " +
                              vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "the triangles are in the model") +
                              " \"" + model->GetName() + "\"");
    });
  if (!failure.empty()) vtkErrorMacro(<< failure);
}

void vtkSlicerFuchsTetrahedralizerLogic::FinishRun()
{
  if (!this->Parameters || !this->Parameters->GetScene()) return;
  for (const char* role : { Parameters::ParentMeshRole(), Parameters::ChildMeshRole(), Parameters::ShellsRole() })
  {
    vtkMRMLModelNode* part = this->TakeResult(role);
    if (!part) continue;
    part->GetDisplayNode()->SetVisibility(false); // it is part of the mesh, at the same position
    part->GetDisplayNode()->SetEdgeVisibility(true);
  }
  if (vtkMRMLModelNode* mesh = this->TakeResult(Parameters::MeshRole())) this->FinishMesh(mesh);
  this->Results.clear();
}

/// Returns the output node with the result, or null if the run has no such result or its node is gone.
vtkMRMLModelNode* vtkSlicerFuchsTetrahedralizerLogic::TakeResult(const std::string& role)
{
  const auto result = this->Results.find(role);
  if (result == this->Results.end() || !result->second->GetMesh()) return nullptr;
  vtkMRMLModelNode* output = this->Parameters->GetModelNode(role.c_str());
  if (!output && role == Parameters::MeshRole())
  {
    const std::vector<vtkMRMLModelNode*> surfaces = surfacesOf(this->Parameters);
    const std::string owner = surfaces.empty() ? std::string() : std::string(surfaces.front()->GetName()) + " ";
    const std::string name = owner + vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "tetrahedra");
    vtkMRMLScene* scene = this->Parameters->GetScene();
    output =
      vtkMRMLModelNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLModelNode", scene->GenerateUniqueName(name)));
    this->Parameters->SetNode(role.c_str(), output);
  }
  if (!output) return nullptr;
  vtkPointSet* mesh = result->second->GetMesh();
  mesh->GetFieldData()->RemoveArray("SPACE");    // it described the file; Slicer adds it again on writing
  output->SetAndObserveTransformNodeID(nullptr); // results are in world coordinates
  output->SetAndObserveMesh(mesh);
  output->CreateDefaultDisplayNodes();
  return output;
}

void vtkSlicerFuchsTetrahedralizerLogic::FinishMesh(vtkMRMLModelNode* mesh)
{
  for (vtkMRMLModelNode* surface : surfacesOf(this->Parameters))
  {
    if (surface->GetDisplayNode()) surface->GetDisplayNode()->SetVisibility(false); // it hides the mesh
  }
  this->UpdateDisplay(this->Parameters);
  double range[2];
  if (this->GetClipRange(this->Parameters, range))
  {
    vtkMRMLSliceNode* slice = this->GetClipSlice(this->Parameters);
    const double offset = slice->GetSliceOffset();
    if (offset < range[0] || offset > range[1]) slice->SetSliceOffset(0.5 * (range[0] + range[1]));
  }
  const std::string failure = failureOf([&] { showReport(mesh, contentOf(this->ReportFile)); });
  if (!failure.empty()) vtkErrorMacro(<< failure);
}

// ---- any tetrahedra -------------------------------------------------------------------------------------------------

bool vtkSlicerFuchsTetrahedralizerLogic::IsMesh(vtkMRMLModelNode* mesh)
{
  return mesh && mesh->GetUnstructuredGrid() && mesh->GetUnstructuredGrid()->GetNumberOfCells() > 0;
}

bool vtkSlicerFuchsTetrahedralizerLogic::UpdateDisplay(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  vtkMRMLModelNode* mesh = parameters->GetModelNode(Parameters::MeshRole());
  if (!IsMesh(mesh)) return false;
  mesh->CreateDefaultDisplayNodes();
  vtkMRMLModelDisplayNode* display = mesh->GetModelDisplayNode();
  const int wasModifying = display->StartModify();
  display->SetEdgeVisibility(parameters->GetShowEdges());
  display->SetEdgeColor(0.15, 0.15, 0.15);
  display->SetInterpolation(vtkMRMLDisplayNode::FlatInterpolation);
  display->SetBackfaceCulling(false); // the inside is visible where the mesh is clipped
  clipMesh(mesh, parameters->GetClipPlane(), parameters->GetClipFlipped());
  const bool isColored = colorMesh(mesh, parameters->GetColorBy());
  display->EndModify(wasModifying);
  return isColored;
}

vtkMRMLSliceNode* vtkSlicerFuchsTetrahedralizerLogic::GetClipSlice(vtkMRMLFuchsTetrahedralizerNode* parameters)
{
  return this->GetMRMLScene() ? sliceOfPlane(this->GetMRMLScene(), parameters->GetClipPlane()) : nullptr;
}

bool vtkSlicerFuchsTetrahedralizerLogic::GetClipRange(vtkMRMLFuchsTetrahedralizerNode* parameters, double range[2])
{
  vtkMRMLModelNode* mesh = parameters->GetModelNode(Parameters::MeshRole());
  vtkMRMLSliceNode* slice = this->GetClipSlice(parameters);
  if (!IsMesh(mesh) || !slice) return false;
  double bounds[6];
  mesh->GetRASBounds(bounds);
  vtkMatrix4x4* toWorld = slice->GetSliceToRAS();
  range[0] = VTK_DOUBLE_MAX;
  range[1] = -VTK_DOUBLE_MAX;
  for (int corner = 0; corner < 8; ++corner)
  {
    double offset = 0; // along the normal of the slice, like its own offset
    for (int axis = 0; axis < 3; ++axis)
      offset += toWorld->GetElement(axis, 2) * bounds[2 * axis + (corner >> axis & 1)];
    range[0] = std::min(range[0], offset);
    range[1] = std::max(range[1], offset);
  }
  return true;
}

vtkMRMLPlotChartNode* vtkSlicerFuchsTetrahedralizerLogic::GetHistogram(vtkMRMLModelNode* mesh, int histogram)
{
  return mesh ? vtkMRMLPlotChartNode::SafeDownCast(mesh->GetNthNodeReference(Parameters::HistogramRole(), histogram))
              : nullptr;
}

vtkMRMLTableNode* vtkSlicerFuchsTetrahedralizerLogic::GetQualityTable(vtkMRMLModelNode* mesh)
{
  return mesh ? vtkMRMLTableNode::SafeDownCast(mesh->GetNodeReference(Parameters::QualityTableRole())) : nullptr;
}

std::string vtkSlicerFuchsTetrahedralizerLogic::Assess(vtkMRMLModelNode* mesh)
{
  return failureOf([mesh] { assessMesh(mesh); });
}

std::vector<vtkSlicerFuchsTetrahedralizerLogic::Format> vtkSlicerFuchsTetrahedralizerLogic::GetExportFormats()
{
  std::vector<Format> formats;
  for (const ExportFormat& format : exportFormats()) formats.push_back({ format.extension, format.description });
  return formats;
}

bool vtkSlicerFuchsTetrahedralizerLogic::HasExportExtension(const std::string& file)
{
  return hasExportExtension(file);
}

std::string vtkSlicerFuchsTetrahedralizerLogic::Export(vtkMRMLFuchsTetrahedralizerNode* parameters,
                                                       const std::string& file)
{
  return failureOf(
    [&]
    {
      vtkMRMLModelNode* mesh = parameters->GetModelNode(Parameters::MeshRole());
      if (!mesh) throw InputError("no mesh is chosen");
      const MeshFile content = meshOfModel(mesh);
      const std::set<Label> present(content.mesh.labels.begin(), content.mesh.labels.end());
      requireOrder(file, parameters->GetExportElements() == Parameters::FourNodes ? 1 : 2);
      const FiniteElementModel model =
        asExported(finiteElementModel(content, optionsOf(parameters, content.tissues, present)), parameters);
      OutputFiles outputs;
      exportModel(model, file, [&outputs](const std::string& finalPath) { return outputs.temporary(finalPath); });
      outputs.commit();
    });
}
