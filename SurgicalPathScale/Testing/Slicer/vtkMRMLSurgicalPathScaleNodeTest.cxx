// SPDX-License-Identifier: Apache-2.0
// The parameter node: its own methods, what it tells of its inputs, and what a scene gives back.

#include "vtkMRMLSurgicalPathScaleNode.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLMarkupsClosedCurveNode.h>
#include <vtkMRMLMarkupsCurveNode.h>
#include <vtkMRMLMarkupsDisplayNode.h>
#include <vtkMRMLMarkupsFiducialNode.h>
#include <vtkMRMLMarkupsLineNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTransformNode.h>

#include <vtkMatrix4x4.h>
#include <vtkNew.h>

using Node = vtkMRMLSurgicalPathScaleNode;

namespace
{

void fill(Node* node)
{
  node->SetMinimumEdgeLength(0.123456789);
  node->SetMaximumEdgeLength(12.5);
  node->SetChildRadius(0);
  node->SetDecayLength(31);
  node->SetSpacing(1.25);
  node->SetPathChildRadius(4);
  node->SetPathDecayLength(17);
  node->SetGradation(0.3);
  node->SetCombine("targets");
  node->SetTissueLengths("a \"quoted\" & <odd> name.csv");
  node->SetNullDisplacementRadius(40);
  node->SetNullDisplacementPathDistance(20);
  node->SetNullDisplacementPathDistanceAtTarget(10);
  node->SetNullDisplacementTissues("brain, \"white matter\", 17");
}

int checkFilled(Node* node)
{
  CHECK_DOUBLE(node->GetMinimumEdgeLength(), 0.123456789);
  CHECK_DOUBLE(node->GetMaximumEdgeLength(), 12.5);
  CHECK_DOUBLE(node->GetChildRadius(), 0);
  CHECK_DOUBLE(node->GetDecayLength(), 31);
  CHECK_DOUBLE(node->GetSpacing(), 1.25);
  CHECK_DOUBLE(node->GetPathChildRadius(), 4);
  CHECK_DOUBLE(node->GetPathDecayLength(), 17);
  CHECK_DOUBLE(node->GetGradation(), 0.3);
  CHECK_STD_STRING(node->GetCombine(), "targets");
  CHECK_STD_STRING(node->GetTissueLengths(), "a \"quoted\" & <odd> name.csv");
  CHECK_DOUBLE(node->GetNullDisplacementRadius(), 40);
  CHECK_DOUBLE(node->GetNullDisplacementPathDistance(), 20);
  CHECK_DOUBLE(node->GetNullDisplacementPathDistanceAtTarget(), 10);
  CHECK_STD_STRING(node->GetNullDisplacementTissues(), "brain, \"white matter\", 17");
  return EXIT_SUCCESS;
}

void registerClasses(vtkMRMLScene* scene)
{
  scene->RegisterNodeClass(vtkNew<Node>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsFiducialNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsCurveNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsLineNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsDisplayNode>());
}

Node* addNode(vtkMRMLScene* scene)
{
  registerClasses(scene);
  return Node::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLSurgicalPathScaleNode"));
}

int checkValues()
{
  vtkNew<Node> node;
  EXERCISE_ALL_BASIC_MRML_METHODS(node.GetPointer());
  fill(node);
  CHECK_EXIT_SUCCESS(checkFilled(node));
  vtkNew<vtkMRMLCoreTestingUtilities::vtkMRMLNodeCallback> events;
  node->AddObserver(vtkCommand::ModifiedEvent, events);
  fill(node);
  CHECK_INT(events->GetTotalNumberOfEvents(), 0); // nothing new
  node->SetDecayLength(32);
  CHECK_INT(events->GetNumberOfEvents(vtkCommand::ModifiedEvent), 1);
  fill(node);
  vtkNew<Node> copy;
  copy->CopyContent(node);
  CHECK_EXIT_SUCCESS(checkFilled(copy));
  CHECK_BOOL(node->WantsNullDisplacement(), true);
  node->SetNullDisplacementRadius(0);
  CHECK_BOOL(node->WantsNullDisplacement(), true);
  node->SetNullDisplacementPathDistance(0);
  CHECK_BOOL(node->WantsNullDisplacement(), false);
  return EXIT_SUCCESS;
}

int checkMarkups()
{
  vtkNew<vtkMRMLScene> scene;
  Node* node = addNode(scene);
  auto* points = scene->AddNewNodeByClass("vtkMRMLMarkupsFiducialNode");
  auto* morePoints = scene->AddNewNodeByClass("vtkMRMLMarkupsFiducialNode");
  auto* curve = scene->AddNewNodeByClass("vtkMRMLMarkupsCurveNode");
  auto* line = scene->AddNewNodeByClass("vtkMRMLMarkupsLineNode");
  node->SetNode(Node::TargetsRole(), points);
  node->SetNode(Node::PathRole(), curve);
  node->SetNodes(Node::FurtherMarkupsRole(), { line, morePoints });
  CHECK_INT(int(node->GetTargetNodes().size()), 2);
  CHECK_POINTER(node->GetTargetNodes()[1], morePoints);
  CHECK_INT(int(node->GetPathNodes().size()), 2);
  CHECK_POINTER(node->GetPathNodes()[1], line);

  vtkNew<vtkMRMLCoreTestingUtilities::vtkMRMLNodeCallback> events;
  node->AddObserver(Node::InputModifiedEvent, events);
  vtkMRMLMarkupsNode::SafeDownCast(morePoints)->AddControlPoint(1, 2, 3);
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true);
  events->ResetNumberOfEvents();
  auto* transform = vtkMRMLTransformNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLTransformNode"));
  vtkMRMLTransformableNode::SafeDownCast(curve)->SetAndObserveTransformNodeID(transform->GetID());
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true);
  events->ResetNumberOfEvents();
  node->SetNodes(Node::FurtherMarkupsRole(), { line });
  vtkMRMLMarkupsNode::SafeDownCast(morePoints)->AddControlPoint(4, 5, 6);
  CHECK_INT(events->GetNumberOfEvents(Node::InputModifiedEvent), 0); // no input any more

  scene->RemoveNode(curve);
  CHECK_INT(int(node->GetPathNodes().size()), 1);
  scene->RemoveNode(points);
  CHECK_INT(int(node->GetTargetNodes().size()), 0);
  return EXIT_SUCCESS;
}

int checkSceneRoundTrip()
{
  vtkNew<vtkMRMLScene> scene;
  Node* node = addNode(scene);
  fill(node);
  node->SetNode(Node::TargetsRole(), scene->AddNewNodeByClass("vtkMRMLMarkupsFiducialNode", "points"));
  node->SetNodes(Node::FurtherMarkupsRole(), { scene->AddNewNodeByClass("vtkMRMLMarkupsLineNode", "line"),
                                               scene->AddNewNodeByClass("vtkMRMLMarkupsFiducialNode", "more points") });
  node->SetNode(Node::ScaleRole(), scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode", "scale"));
  scene->SetSaveToXMLString(1);
  scene->Commit();

  vtkNew<vtkMRMLScene> read;
  registerClasses(read);
  read->SetLoadFromXMLString(1);
  read->SetSceneXMLString(scene->GetSceneXMLString());
  read->Import();
  auto* restored = Node::SafeDownCast(read->GetFirstNodeByClass("vtkMRMLSurgicalPathScaleNode"));
  CHECK_NOT_NULL(restored);
  CHECK_EXIT_SUCCESS(checkFilled(restored));
  CHECK_INT(int(restored->GetTargetNodes().size()), 2);
  CHECK_STRING(restored->GetTargetNodes()[0]->GetName(), "points");
  CHECK_STRING(restored->GetTargetNodes()[1]->GetName(), "more points");
  CHECK_INT(int(restored->GetPathNodes().size()), 1);
  CHECK_STRING(restored->GetScalarVolumeNode(Node::ScaleRole())->GetName(), "scale");
  vtkNew<vtkMRMLCoreTestingUtilities::vtkMRMLNodeCallback> events;
  restored->AddObserver(Node::InputModifiedEvent, events);
  restored->GetTargetNodes()[1]->AddControlPoint(1, 2, 3);
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true); // inputs are observed again
  return EXIT_SUCCESS;
}

/// The values that fill() sets and a role, as version 0.1 has written them.
int checkSavedScene()
{
  vtkNew<vtkMRMLScene> scene;
  registerClasses(scene);
  scene->SetLoadFromXMLString(1);
  scene->SetSceneXMLString(
    R"(<MRML version="Slicer5.0.3" userTags=""><Volume id="vtkMRMLScalarVolumeNode1" name="scale"></Volume>
<SurgicalPathScale id="vtkMRMLSurgicalPathScaleNode1" name="Surgical Path Scale" hideFromEditors="true"
 references="scale:vtkMRMLScalarVolumeNode1;" minimumEdgeLength="0.123456789" maximumEdgeLength="12.5" childRadius="0"
 decayLength="31" spacing="1.25" pathChildRadius="4" pathDecayLength="17" gradation="0.3" combine="targets"
 tissueLengths="a &quot;quoted&quot; &amp; &lt;odd&gt; name.csv" nullDisplacementRadius="40"
 nullDisplacementPathDistance="20" nullDisplacementPathDistanceAtTarget="10"
 nullDisplacementTissues="brain, &quot;white matter&quot;, 17"></SurgicalPathScale></MRML>)");
  scene->Import();
  auto* node = Node::SafeDownCast(scene->GetFirstNodeByClass("vtkMRMLSurgicalPathScaleNode"));
  CHECK_NOT_NULL(node);
  CHECK_STRING(node->GetScalarVolumeNode(Node::ScaleRole())->GetName(), "scale");
  return checkFilled(node);
}

} // namespace

int vtkMRMLSurgicalPathScaleNodeTest(int, char*[])
{
  CHECK_EXIT_SUCCESS(checkValues());
  CHECK_EXIT_SUCCESS(checkMarkups());
  CHECK_EXIT_SUCCESS(checkSceneRoundTrip());
  CHECK_EXIT_SUCCESS(checkSavedScene());
  return EXIT_SUCCESS;
}
