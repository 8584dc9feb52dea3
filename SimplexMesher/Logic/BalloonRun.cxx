// SPDX-License-Identifier: Apache-2.0
#include "BalloonRun.h"

#include "Errors.h"
#include "HostDifferences.h"
#include "MarkupsInput.h"
#include "MeshIO.h"
#include "RunNodes.h"
#include "SceneNodes.h"
#include "TissueColors.h"
#include "TissueMapInput.h"
#include "TissueRows.h"
#include "VolumeNodes.h"
#include "vtkMRMLSimplexMesherNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkSlicerModuleLogic.h>

#include <vtkCallbackCommand.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <vtksys/SystemTools.hxx>

namespace surgicalmesher
{

namespace
{

using Node = vtkMRMLSimplexMesherNode;

vtkMRMLMarkupsNode* seedsOf(Node* parameters)
{
  return vtkMRMLMarkupsNode::SafeDownCast(parameters->GetNodeReference(Node::BalloonSeedsRole()));
}

/// Returns the value of `--stop`; tissues that are gone or have no voxel are left out.
std::string stopsOf(Node* parameters)
{
  std::string labels;
  for (const TissueRow& tissue : listTissues(parameters->GetNodeReference(Node::TissueMapRole())))
    if (parameters->GetBalloonStops().count(tissue.id) > 0 && tissue.voxels != 0)
      labels += (labels.empty() ? "" : ",") + std::to_string(tissue.label);
  return labels;
}

std::string nameAfterMap(Node* parameters, const std::string& what)
{
  return parameters->GetNodeReference(Node::TissueMapRole())->GetName() + (" " + what);
}

/// Moves the voxels of the hidden result to the chosen label map, or to a new one.
vtkMRMLLabelMapVolumeNode* handOver(vtkMRMLLabelMapVolumeNode* result, Node* parameters)
{
  if (vtkMRMLLabelMapVolumeNode* chosen = parameters->GetLabelMapNode(Node::BalloonLabelMapRole()))
  {
    takeVoxels(chosen, result);
    return chosen;
  }
  vtkNew<vtkMRMLLabelMapVolumeNode> made;
  made->SetName(unusedName(parameters->GetScene(), result->GetName()).c_str());
  takeVoxels(made, result);
  parameters->SetNode(Node::BalloonLabelMapRole(), parameters->GetScene()->AddNode(made));
  return made;
}

/// Files are in LPS, the scene in RAS.
void turnIntoRAS(vtkPolyData* surface)
{
  vtkPoints* points = surface->GetPoints();
  for (vtkIdType n = 0; n < points->GetNumberOfPoints(); ++n)
  {
    double p[3];
    points->GetPoint(n, p);
    points->SetPoint(n, -p[0], -p[1], p[2]);
  }
}

} // namespace

BalloonRun::BalloonRun(vtkSlicerModuleLogic* logic) : m_Logic(logic)
{
  m_RunEnded->SetClientData(this);
  m_RunEnded->SetCallback([](vtkObject*, unsigned long, void* self, void*)
                          { static_cast<BalloonRun*>(self)->finish(); });
  m_Run->AddObserver(vtkSurgicalMesherRun::CompletedEvent, m_RunEnded, 1); // before those of default priority
}

BalloonRun::~BalloonRun() { m_Run->RemoveObserver(m_RunEnded); }

BalloonProblem BalloonRun::findProblem(vtkMRMLSimplexMesherNode* parameters) const
{
  if (!m_Logic->GetModuleLogic("BalloonSurfaceCLI")) return BalloonProblem::NoModule;
  if (markupsPoints(seedsOf(parameters)).empty()) return BalloonProblem::NoSeeds;
  return parameters->GetBalloonStops().empty() ? BalloonProblem::NothingStops : BalloonProblem::None;
}

bool BalloonRun::start(vtkMRMLSimplexMesherNode* parameters) { return this->prepare(parameters) && m_Run->Start(); }

bool BalloonRun::prepare(vtkMRMLSimplexMesherNode* parameters)
{
  if (m_Run->IsBusy() || this->findProblem(parameters) != BalloonProblem::None) return false;
  const TissueMapNodes map = makeTissueMapNodes(parameters->GetNodeReference(Node::TissueMapRole()));
  if (map.problem != TissueMapProblem::None) return false;
  m_Run->SetCommandLineLogic(m_Logic->GetModuleLogic("BalloonSurfaceCLI"));
  const auto setInput = [&](const char* name, vtkMRMLNode* node)
  {
    if (!node) return;
    m_Run->AddTemporaryNode(node);
    m_Run->SetParameterNode(name, node);
  };
  setInput("map", map.labelMap);
  setInput("names", map.colors);
  if (parameters->GetUseScale()) setInput("scale", copyForRun(parameters->GetScalarVolumeNode(Node::ScaleRole())));
  else m_Run->SetParameter("edgeLength", parameters->GetEdgeLength());
  if (!this->prepareSeeds(parameters)) return false;
  m_Run->SetParameter("stop", stopsOf(parameters));
  m_Run->SetParameter("limit", parameters->GetBalloonLimit());
  m_Run->SetParameter("rigidity", parameters->GetBalloonRigidity());
  m_Run->SetParameter("threads", parameters->GetThreads());
  this->prepareOutputs(parameters);
  m_Parameters = parameters;
  return true;
}

/// Returns false, with the run's error, if the temporary file can't be written.
bool BalloonRun::prepareSeeds(vtkMRMLSimplexMesherNode* parameters)
{
  const std::string seeds = m_Run->NewTemporaryFile(".mrk.json");
  try
  {
    writeLabelledMarkups({ labelledPoints(seedsOf(parameters)) }, seeds);
  }
  catch (const Error& error)
  {
    m_Run->SetCommandLineLogic(nullptr); // releases the nodes
    m_Run->SetErrorText(error.what());
    return false;
  }
  m_Run->SetParameter("seeds", seeds);
  return true;
}

void BalloonRun::prepareOutputs(vtkMRMLSimplexMesherNode* parameters)
{
  vtkMRMLScene* scene = parameters->GetScene();
  m_Surface = outputModel(parameters->GetModelNode(Node::BalloonSurfaceRole()), scene,
                          nameAfterMap(parameters, vtkMRMLTr("SimplexMesher", "balloons")), m_Run);
  m_Run->SetParameterNode("surface", m_Surface);
  m_LabelMap = vtkSmartPointer<vtkMRMLLabelMapVolumeNode>::New();
  m_LabelMap->SetName(nameAfterMap(parameters, vtkMRMLTr("SimplexMesher", "with balloons")).c_str());
  giveOneVoxel(m_LabelMap);
  m_Run->AddTemporaryNode(m_LabelMap);
  m_Run->SetParameterNode("labelMap", m_LabelMap);

  vtkNew<vtkMRMLModelNode> growth;
  growth->SetName(vtkMRMLTr("SimplexMesher", "growing balloons").c_str());
  m_Run->AddTemporaryNode(growth);
  growth->CreateDefaultDisplayNodes();
  m_Run->AddTemporaryNode(growth->GetDisplayNode());
  m_Growth = growth;
  m_GrowthIndex = m_Run->NewTemporaryFile(".pvd");
  m_ShownMotion = 0;
  m_Run->SetParameter("growth", m_GrowthIndex);
}

bool BalloonRun::showGrowth()
{
  if (!m_Growth || !m_Run->IsBusy()) return false;
  constexpr int interval = 10; // motions between the files of BalloonSurfaceCLI
  const std::string stem = vtksys::SystemTools::GetFilenamePath(m_GrowthIndex) + "/" +
                           vtksys::SystemTools::GetFilenameWithoutLastExtension(m_GrowthIndex) + "-";
  const auto fileAfter = [&](int motion) { return stem + std::to_string(motion) + ".vtp"; };
  int newest = m_ShownMotion;
  while (vtksys::SystemTools::FileExists(fileAfter(newest + interval))) newest += interval;
  if (newest == m_ShownMotion) return false;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(fileAfter(newest).c_str());
  reader->Update();
  turnIntoRAS(reader->GetOutput());
  m_Growth->SetAndObservePolyData(reader->GetOutput());
  m_ShownMotion = newest;
  return true;
}

vtkMRMLModelNode* BalloonRun::growth() const { return m_Growth; }

void BalloonRun::finish()
{
  vtkMRMLSimplexMesherNode* parameters = m_Parameters;
  if (m_Run->GetStatus() != vtkSurgicalMesherRun::Completed || !parameters || !parameters->GetScene()) return;
  if (!m_Surface || !m_Surface->GetScene() || !hasVoxels(m_LabelMap)) return;
  const int wasModifying = parameters->StartModify();
  parameters->SetNode(Node::BalloonSurfaceRole(), m_Surface);
  vtkMRMLLabelMapVolumeNode* labelMap = handOver(m_LabelMap, parameters);
  vtkMRMLColorTableNode* colors = showTissueColors(m_Surface, "BoundaryLabels");
  TissueTable tissues = tissueTable(parameters->GetNodeReference(Node::TissueMapRole()));
  for (const auto& [label, tissue] : tissuesOf(m_Surface->GetMesh()->GetFieldData())) tissues[label] = tissue;
  fillColorTable(withDistinctColors(tissues), colors);
  labelMap->CreateDefaultDisplayNodes();
  labelMap->GetDisplayNode()->SetAndObserveColorNodeID(colors->GetID());
  keepNullDisplacement(labelMap, tissues);
  parameters->EndModify(wasModifying);
}

} // namespace surgicalmesher
