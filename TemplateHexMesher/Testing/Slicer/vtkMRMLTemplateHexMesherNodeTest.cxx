// SPDX-License-Identifier: Apache-2.0
// The parameter node: its own methods, what it tells of landmarks, and what a scene gives back.

#include "vtkMRMLTemplateHexMesherNode.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLMarkupsDisplayNode.h>
#include <vtkMRMLMarkupsFiducialNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <vtkNew.h>

using Node = vtkMRMLTemplateHexMesherNode;

namespace
{

void fill(Node* node)
{
  node->SetSideBySide(true);
  node->SetShowPreview(false);
  node->SetColorByQuality(false);
  node->SetAlpha(0.5);
  node->SetIterations(30);
  node->SetLandmarkWeight(1.5);
}

int checkFilled(Node* node)
{
  CHECK_BOOL(node->GetSideBySide(), true);
  CHECK_BOOL(node->GetShowPreview(), false);
  CHECK_BOOL(node->GetColorByQuality(), false);
  CHECK_DOUBLE(node->GetAlpha(), 0.5);
  CHECK_INT(node->GetIterations(), 30);
  CHECK_DOUBLE(node->GetLandmarkWeight(), 1.5);
  return EXIT_SUCCESS;
}

Node* addNode(vtkMRMLScene* scene)
{
  scene->RegisterNodeClass(vtkNew<Node>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsFiducialNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsDisplayNode>());
  return Node::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLTemplateHexMesherNode"));
}

int checkValues()
{
  vtkNew<Node> node;
  EXERCISE_ALL_BASIC_MRML_METHODS(node.GetPointer());
  fill(node);
  CHECK_EXIT_SUCCESS(checkFilled(node));
  vtkNew<Node> copy;
  copy->CopyContent(node);
  return checkFilled(copy);
}

int checkSceneRoundTrip()
{
  vtkNew<vtkMRMLScene> scene;
  Node* node = addNode(scene);
  fill(node);
  node->SetNode(Node::TemplateRole(), scene->AddNewNodeByClass("vtkMRMLModelNode", "face"));
  node->SetNodes(Node::CarriedRole(), { scene->AddNewNodeByClass("vtkMRMLModelNode", "masseter"),
                                        scene->AddNewNodeByClass("vtkMRMLModelNode", "buccinator") });
  node->SetNode(Node::TargetLandmarksRole(), scene->AddNewNodeByClass("vtkMRMLMarkupsFiducialNode", "points"));
  scene->SetSaveToXMLString(1);
  scene->Commit();

  vtkNew<vtkMRMLScene> read;
  addNode(read);
  read->Clear(1);
  read->SetLoadFromXMLString(1);
  read->SetSceneXMLString(scene->GetSceneXMLString());
  read->Import();
  auto* restored = Node::SafeDownCast(read->GetFirstNodeByClass("vtkMRMLTemplateHexMesherNode"));
  CHECK_NOT_NULL(restored);
  CHECK_EXIT_SUCCESS(checkFilled(restored));
  CHECK_STRING(restored->GetModelNode(Node::TemplateRole())->GetName(), "face");
  CHECK_INT(int(restored->GetNodes(Node::CarriedRole()).size()), 2);
  CHECK_STRING(restored->GetNodes(Node::CarriedRole())[1]->GetName(), "buccinator");
  vtkMRMLMarkupsNode* points = restored->GetMarkupsNode(Node::TargetLandmarksRole());
  CHECK_STRING(points->GetName(), "points");
  vtkNew<vtkMRMLCoreTestingUtilities::vtkMRMLNodeCallback> events;
  restored->AddObserver(Node::InputModifiedEvent, events);
  points->AddControlPoint(1, 2, 3);
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true); // inputs are observed again
  events->ResetNumberOfEvents();
  points->SetNthControlPointPosition(0, 3, 2, 1);
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true);
  events->ResetNumberOfEvents();
  points->RemoveNthControlPoint(0);
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true);
  return EXIT_SUCCESS;
}

} // namespace

int vtkMRMLTemplateHexMesherNodeTest(int, char*[])
{
  CHECK_EXIT_SUCCESS(checkValues());
  CHECK_EXIT_SUCCESS(checkSceneRoundTrip());
  return EXIT_SUCCESS;
}
