// SPDX-License-Identifier: Apache-2.0
// What a user can do wrong, or at the wrong moment: a sentence, no crash, and nothing left in the scene or on the disk.

#include "Panel.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLTransformNode.h>
#include <vtkSegmentation.h>

#include <vtkImageData.h>

#include <QRadioButton>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLSimplexMesherNode;

namespace
{

/// Works for several seconds: to be interrupted.
vtkMRMLLabelMapVolumeNode* addSlowMap(vtkMRMLScene* scene)
{
  return addLabelMap(scene, "Slow", 90, 1, [](const Point& p) { return 1 + (p[0] > 5) + 2 * (p[1] * p[2] > 0); });
}

/// A segmentation, in a scene without any label map.
vtkMRMLSegmentationNode* addSegmentsAlone(vtkMRMLScene* scene)
{
  vtkMRMLLabelMapVolumeNode* balls = addNestedBalls(scene);
  vtkMRMLSegmentationNode* segments = addSegmentation(scene, balls);
  scene->RemoveNode(balls);
  return segments;
}

bool says(const Panel& panel, const char* words) { return panel.problem().find(words) != std::string::npos; }

/// The host may show a label map in the slice views as soon as it is in the scene: one that the panel makes for the
/// result is drawn before there is a result, and while a second run replaces it.
int testResultInSliceViews(Panel& panel)
{
  vtkMRMLScene* scene = panel.host.scene();
  CHECK_INT(scene->GetNumberOfNodesByClass("vtkMRMLVolumeNode"), 0); // nothing has been drawn before
  for (const char* selector : { "PreparedLabelMapSelector", "FollowedScaleSelector" })
  {
    vtkMRMLNode* result = panel.child<qMRMLNodeComboBox>(selector)->addNode();
    CHECK_NOT_NULL(result);
    showInSliceViews(vtkMRMLVolumeNode::SafeDownCast(result));
    panel.host.waitFor(0.2);
  }
  panel.choose("TissueMapSelector", addSegmentsAlone(scene));
  panel.child<QRadioButton>("EdgeLengthRadioButton")->setChecked(true);
  for (int run = 0; run < 2; ++run)
  {
    CHECK_BOOL(panel.apply(), true);
    CHECK_STD_STRING(panel.run->GetErrorText(), "");
    CHECK_BOOL(panel.node()->GetLabelMapNode(Node::PreparedLabelMapRole())->GetImageData()->GetScalarRange()[1] == 2,
               true);
    panel.host.waitFor(0.2);
  }
  CHECK_STD_STRING(panel.host.complaints(), "");
  scene->Clear(0);
  panel.host.waitFor(0.2);
  CHECK_STD_STRING(panel.host.complaints(), "");
  return EXIT_SUCCESS;
}

int testInputs(Panel& panel)
{
  vtkMRMLScene* scene = panel.host.scene();
  panel.child<QRadioButton>("EdgeLengthRadioButton")->setChecked(true);
  panel.choose("TissueMapSelector", addEmptySegmentation(scene));
  CHECK_BOOL(says(panel, "no segments"), true);
  vtkMRMLSegmentationNode* segments = addSegmentation(scene, addNestedBalls(scene));
  panel.choose("TissueMapSelector", segments);
  CHECK_STD_STRING(panel.problem(), "");
  CHECK_INT(int(panel.table()->tissues().size()), 2);
  segments->GetSegmentation()->RemoveSegment(segments->GetSegmentation()->GetNthSegmentID(0));
  CHECK_BOOL(panel.host.waitUntil([&] { return panel.table()->tissues().size() == 1; }), true);
  segments->GetSegmentation()->RemoveAllSegments();
  CHECK_BOOL(panel.host.waitUntil([&] { return says(panel, "no segments"); }), true);
  vtkMRMLNode* background = addLabelMap(scene, "Background", 8, 1, [](const Point&) { return 0; });
  panel.choose("TissueMapSelector", background);
  CHECK_BOOL(says(panel, "No voxel"), true);
  panel.choose("TissueMapSelector", addLabelMap(scene, "Negative", 8, 1, [](const Point&) { return -1; }));
  CHECK_BOOL(panel.problem().empty(), false);
  CHECK_BOOL(panel.child<QPushButton>("ApplyButton")->isEnabled(), false);
  CHECK_BOOL(panel.logic->Start(panel.node()), false);
  panel.host.complaints();
  return EXIT_SUCCESS;
}

int testScale(Panel& panel)
{
  vtkMRMLScene* scene = panel.host.scene();
  vtkMRMLLabelMapVolumeNode* balls = addNestedBalls(scene);
  panel.choose("TissueMapSelector", balls);
  panel.child<QRadioButton>("ScaleRadioButton")->setChecked(true);
  panel.choose("ScaleSelector", nullptr);
  CHECK_BOOL(says(panel, "scale volume"), true);
  auto* scale = vtkMRMLScalarVolumeNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode", "scale"));
  panel.choose("ScaleSelector", scale);
  CHECK_BOOL(says(panel, "scale volume"), true); // no voxels yet
  vtkMRMLNode* small = addLabelMap(scene, "small", 10, 1, [](const Point&) { return 3; });
  auto* smallMap = vtkMRMLLabelMapVolumeNode::SafeDownCast(small);
  scale->SetAndObserveImageData(smallMap->GetImageData());
  scale->CopyOrientation(smallMap);
  CHECK_BOOL(panel.host.waitUntil([&] { return says(panel, "doesn't cover"); }), true);
  scale->SetSpacing(3, 3, 3);
  scale->SetOrigin(-13.5, -13.5, -13.5);
  CHECK_BOOL(panel.host.waitUntil([&] { return panel.problem().empty(); }), true);
  scale->SetAndObserveTransformNodeID(addTransform(scene)->GetID());
  CHECK_BOOL(panel.host.waitUntil([&] { return says(panel, "doesn't cover"); }), true);
  balls->SetAndObserveTransformNodeID(scale->GetTransformNodeID()); // both: as before
  CHECK_BOOL(panel.host.waitUntil([&] { return panel.problem().empty(); }), true);
  CHECK_BOOL(panel.apply(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  scene->RemoveNode(scale);
  CHECK_BOOL(says(panel, "scale volume"), true);
  return EXIT_SUCCESS;
}

/// A run of `map` that has begun, with a new surface.
bool beginRun(Panel& panel, vtkMRMLNode* map)
{
  panel.choose("TissueMapSelector", map);
  panel.choose("SurfaceSelector", nullptr);
  panel.child<QRadioButton>("EdgeLengthRadioButton")->setChecked(true);
  panel.press("ApplyButton");
  return panel.run->IsBusy();
}

int testCancel(Panel& panel)
{
  vtkMRMLNode* slow = addSlowMap(panel.host.scene());
  panel.choose("TissueMapSelector", slow);
  panel.choose("SurfaceSelector", nullptr);
  const std::set<std::string> files = temporaryFiles();
  const LeftoverCheck before(panel.host.scene());
  for (const double seconds : { 0.0, 0.05, 0.3, 1.0 })
  {
    CHECK_BOOL(beginRun(panel, slow), true);
    panel.host.waitFor(seconds);
    panel.press("ApplyButton"); // a second time: nothing happens
    CHECK_BOOL(panel.logic->Start(panel.node()), false);
    panel.press("CancelButton");
    CHECK_BOOL(panel.waitForEnd(), true);
    CHECK_INT(panel.run->GetStatus(), vtkSurgicalMesherRun::Cancelled);
    CHECK_STD_STRING(before.leftovers(), "");
    CHECK_NULL(panel.node()->GetModelNode(Node::SurfaceRole()));
    CHECK_BOOL(panel.child<QPushButton>("ApplyButton")->isEnabled(), true);
  }
  CHECK_BOOL(temporaryFiles().size() == files.size(), true); // the last run keeps its folder until the next
  CHECK_STD_STRING(panel.host.complaints(), "");
  return EXIT_SUCCESS;
}

/// The module refuses what the panel can't know: its line is shown, and nothing stays.
int testFailure(Panel& panel)
{
  vtkMRMLScene* scene = panel.host.scene();
  panel.choose("TissueMapSelector", addNestedBalls(scene));
  panel.choose("SurfaceSelector", nullptr);
  auto* scale = vtkMRMLScalarVolumeNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode", "negative"));
  vtkMRMLLabelMapVolumeNode* values = addLabelMap(scene, "values", 26, 1, [](const Point&) { return -1; });
  scale->SetAndObserveImageData(values->GetImageData());
  scale->CopyOrientation(values);
  panel.child<QRadioButton>("ScaleRadioButton")->setChecked(true);
  panel.choose("ScaleSelector", scale);
  const LeftoverCheck before(scene);
  CHECK_BOOL(panel.apply(), true);
  CHECK_INT(panel.run->GetStatus(), vtkSurgicalMesherRun::Failed);
  CHECK_BOOL(panel.run->GetErrorText().empty(), false);
  CHECK_STD_STRING(before.leftovers(), "");
  CHECK_NULL(panel.node()->GetModelNode(Node::SurfaceRole()));
  panel.host.complaints(); // the host's own, on the module's status
  return EXIT_SUCCESS;
}

int testNodesThatLeave(Panel& panel)
{
  vtkMRMLScene* scene = panel.host.scene();
  vtkMRMLNode* balls = addNestedBalls(scene);
  CHECK_BOOL(beginRun(panel, balls), true);
  scene->RemoveNode(balls); // the run has a copy
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), vtkSurgicalMesherRun::Completed);
  vtkMRMLModelNode* surface = panel.node()->GetModelNode(Node::SurfaceRole());
  CHECK_NOT_NULL(surface);
  vtkMRMLNode* ambient = surface->GetNodeReference(Node::AmbientTetrahedraRole());
  const std::string ambientID = ambient->GetID();
  scene->RemoveNode(surface);
  CHECK_NULL(scene->GetNodeByID(ambientID.c_str())); // hidden: nobody else could remove it

  vtkMRMLNode* slow = addSlowMap(scene);
  const LeftoverCheck before(scene);
  CHECK_BOOL(beginRun(panel, slow), true);
  panel.host.waitFor(0.2);
  vtkMRMLNode* unfinished = scene->GetFirstNodeByName("Slow surface");
  CHECK_NOT_NULL(unfinished);
  scene->RemoveNode(unfinished); // where the result should go
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), vtkSurgicalMesherRun::Cancelled);
  CHECK_STD_STRING(before.leftovers(), "");

  CHECK_BOOL(beginRun(panel, slow), true);
  scene->RemoveNode(panel.node());
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), vtkSurgicalMesherRun::Cancelled);
  CHECK_NOT_NULL(panel.node());
  return EXIT_SUCCESS;
}

int testClosedScene(Panel& panel)
{
  CHECK_BOOL(beginRun(panel, addSlowMap(panel.host.scene())), true);
  panel.host.waitFor(0.3);
  panel.host.scene()->Clear(0);
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), vtkSurgicalMesherRun::Cancelled);
  CHECK_INT(panel.host.scene()->GetNumberOfNodesByClass("vtkMRMLModelNode"), 3); // the slices'
  CHECK_BOOL(says(panel, "no segmentation"), true);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerSimplexMesherModuleStatesTest(int, char*[])
{
  HostApplication host;
  Panel panel{ host };
  CHECK_EXIT_SUCCESS(testResultInSliceViews(panel));
  CHECK_EXIT_SUCCESS(testInputs(panel));
  CHECK_EXIT_SUCCESS(testScale(panel));
  CHECK_EXIT_SUCCESS(testCancel(panel));
  CHECK_EXIT_SUCCESS(testFailure(panel));
  CHECK_EXIT_SUCCESS(testNodesThatLeave(panel));
  CHECK_EXIT_SUCCESS(testClosedScene(panel));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}
