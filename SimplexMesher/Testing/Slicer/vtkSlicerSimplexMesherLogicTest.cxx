// SPDX-License-Identifier: Apache-2.0
// The logic without its panel: the tissues it lists, what it makes of settings by tissue, and its waiting run.

#include "vtkSlicerSimplexMesherLogic.h"
#include "HostApplication.h"
#include "HostScene.h"
#include "TissueRows.h"
#include "vtkMRMLSimplexMesherNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLCommandLineModuleNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLTableNode.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPolyData.h>
#include <vtkSegmentation.h>
#include <vtkSlicerCLIModuleLogic.h>

#include <string>
#include <utility>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLSimplexMesherNode;
using Logic = vtkSlicerSimplexMesherLogic;

namespace
{

/// Four tissues side by side along x, 10 mm each: 1, 2, 3, 4.
vtkMRMLLabelMapVolumeNode* addSlabs(vtkMRMLScene* scene)
{
  return addLabelMap(scene, "Slabs", 40, 1, [](const Point& p) { return 1 + int((p[0] + 20) / 10); });
}

int testRows(vtkMRMLScene* scene)
{
  vtkMRMLLabelMapVolumeNode* balls = addNestedBalls(scene);
  balls->SetSpacing(1, 2, 0.5);
  const std::vector<TissueRow> labels = listTissues(balls);
  CHECK_INT(int(labels.size()), 2);
  CHECK_STD_STRING(labels[0].id, "1");
  CHECK_STD_STRING(labels[0].name, "tumour");
  CHECK_DOUBLE(labels[0].volume, double(labels[0].voxels));
  balls->SetSpacing(1, 1, 1);

  vtkMRMLSegmentationNode* segmentation = addSegmentation(scene, balls);
  const std::vector<TissueRow> segments = listTissues(segmentation);
  CHECK_INT(int(segments.size()), 2);
  CHECK_STD_STRING(segments[1].id, segmentation->GetSegmentation()->GetNthSegmentID(1));
  CHECK_STD_STRING(segments[1].name, "brain");
  CHECK_INT(segments[1].label, 2);
  for (int i = 0; i < 2; ++i) CHECK_BOOL(segments[i].voxels == labels[i].voxels && segments[i].voxels > 0, true);
  CHECK_INT(int(listTissues(addEmptySegmentation(scene)).size()), 0);
  CHECK_INT(int(listTissues(nullptr).size()), 0);
  return EXIT_SUCCESS;
}

std::set<int> labelsOf(vtkMRMLModelNode* surface)
{
  std::set<int> labels;
  vtkDataArray* sides = surface->GetPolyData()->GetCellData()->GetArray("BoundaryLabels");
  for (vtkIdType t = 0; t < sides->GetNumberOfTuples(); ++t)
  {
    for (int side = 0; side < 2; ++side) labels.insert(int(sides->GetComponent(t, side)));
  }
  return labels;
}

/// 1 and 2 become one tissue, 3 is left out, 4 is a shell; one setting is of a tissue that isn't there.
int testSettings(Logic* logic)
{
  vtkMRMLSimplexMesherNode* node = logic->ParameterNode();
  node->SetNode(vtkMRMLSimplexMesherNode::TissueMapRole(), addSlabs(logic->GetMRMLScene()));
  node->UseScaleOff();
  node->SetEdgeLength(5);
  TissueSetting group, left, shell;
  group.role = TissueRole::Group;
  group.group = "a \"pair\", joined";
  left.role = TissueRole::Leave;
  shell.role = TissueRole::Shell;
  shell.minimumEdgeLength = 4;
  node->SetTissueSettings({ { "1", group }, { "2", group }, { "3", left }, { "4", shell }, { "9", left } });
  CHECK_BOOL(logic->StartAndWait(node), true);
  CHECK_STD_STRING(logic->GetRun()->GetErrorText(), "");
  CHECK_INT(logic->GetRun()->GetStatus(), vtkSurgicalMesherRun::Completed);
  CHECK_BOOL(labelsOf(node->GetModelNode(Node::SurfaceRole())) == (std::set<int>{ 0, 1, 4 }), true);
  CHECK_STD_STRING(node->GetTableNode(Node::TissueTableRole())->GetCellText(0, 1).substr(0, 3), "a '");
  return EXIT_SUCCESS;
}

/// Whoever leaves the panel as it is gets what the command line makes without options.
int testDefaults(Logic* logic)
{
  auto* module = vtkSlicerCLIModuleLogic::SafeDownCast(logic->GetModuleLogic("SimplexMesherCLI"));
  CHECK_NOT_NULL(module);
  const auto line = vtkSmartPointer<vtkMRMLCommandLineModuleNode>::Take(module->CreateNode());
  const auto number = [&](const char* name) { return std::stod(line->GetParameterAsString(name)); };
  vtkNew<vtkMRMLSimplexMesherNode> node;
  CHECK_DOUBLE(node->GetMinimumIslandVolume(), number("minimumIslandVolume"));
  CHECK_DOUBLE(node->GetMinimumCavityVolume(), number("minimumCavityVolume"));
  CHECK_DOUBLE(node->GetFeatureScale(), number("featureScale"));
  CHECK_DOUBLE(node->GetSmoothing(), number("smoothing"));
  CHECK_DOUBLE(node->GetRigidity(), number("rigidity"));
  CHECK_DOUBLE(node->GetContinuity(), number("continuity"));
  CHECK_DOUBLE(node->GetMaximumDistance(), number("maximumDistance"));
  CHECK_DOUBLE(node->GetChordError(), number("chordError"));
  CHECK_DOUBLE(node->GetGradation(), number("gradation"));
  CHECK_DOUBLE(node->GetBackground(), number("background"));
  CHECK_DOUBLE(node->GetThreads(), number("threads"));
  CHECK_STD_STRING(line->GetParameterAsString("proximity"), "0,0");
  CHECK_BOOL(node->GetProximityNear() == 0 && node->GetProximityFar() == 0, true);
  return EXIT_SUCCESS;
}

int testProblems(Logic* logic)
{
  vtkMRMLSimplexMesherNode* node = logic->ParameterNode();
  const std::vector<TissueRow> rows = listTissues(node->GetNodeReference(Node::TissueMapRole()));
  CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::None, true);
  for (const auto& [near, far] : { std::pair{ 0., 2. }, std::pair{ 2., 1. }, std::pair{ 2., 0. } })
  {
    node->SetProximityNear(near);
    node->SetProximityFar(far);
    CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::ProximityUnfit, true);
    CHECK_BOOL(logic->FindProblem(node, {}).problem == Logic::Problem::None, true); // no matter to balloons
  }
  node->SetProximityFar(2);
  CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::None, true);
  node->SetBackground(3);
  CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::LabelTaken, true);
  CHECK_INT(logic->FindProblem(node, rows).tissue.label, 3);
  node->SetBackground(5);
  CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::None, true);
  TissueSetting wrong;
  wrong.minimumEdgeLength = 3;
  wrong.maximumEdgeLength = 2;
  node->SetTissueSetting("2", wrong);
  CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::LengthsContradict, true);
  wrong.role = TissueRole::Leave; // whatever else it says
  node->SetTissueSettings({ { "1", wrong }, { "2", wrong }, { "3", wrong }, { "4", wrong } });
  CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::NothingToMesh, true);
  node->SetTissueSettings({});
  node->SetEdgeLength(0);
  CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::NoEdgeLength, true);
  node->UseScaleOn();
  CHECK_BOOL(logic->FindProblem(node, rows).problem == Logic::Problem::NoScale, true);
  node->SetNode(vtkMRMLSimplexMesherNode::TissueMapRole(), nullptr);
  CHECK_BOOL(logic->FindProblem(node, {}).problem == Logic::Problem::TissueMap, true);
  return EXIT_SUCCESS;
}

} // namespace

int vtkSlicerSimplexMesherLogicTest(int, char*[])
{
  HostApplication host;
  Logic* logic = Logic::SafeDownCast(host.logic("SimplexMesher"));
  EXERCISE_BASIC_OBJECT_METHODS(logic);
  CHECK_EXIT_SUCCESS(testRows(host.scene()));
  CHECK_EXIT_SUCCESS(testDefaults(logic));
  CHECK_EXIT_SUCCESS(testSettings(logic));
  CHECK_EXIT_SUCCESS(testProblems(logic));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}
