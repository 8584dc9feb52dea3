// SPDX-License-Identifier: Apache-2.0
// The logic without its panel: the tissues it lists, what it makes of settings by tissue, and its waiting run.

#include "vtkSlicerSimplexMesherLogic.h"
#include "HostApplication.h"
#include "HostScene.h"
#include "TissueRows.h"
#include "vtkMRMLSimplexMesherNode.h"
#include "vtkSurgicalMesherRun.h"

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

int testProblems(Logic* logic)
{
  vtkMRMLSimplexMesherNode* node = logic->ParameterNode();
  const std::vector<TissueRow> rows = listTissues(node->GetNodeReference(Node::TissueMapRole()));
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
  CHECK_EXIT_SUCCESS(testSettings(logic));
  CHECK_EXIT_SUCCESS(testProblems(logic));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}
