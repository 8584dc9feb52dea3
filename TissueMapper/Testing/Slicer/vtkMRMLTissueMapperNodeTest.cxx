// SPDX-License-Identifier: Apache-2.0
// The parameter node: its own methods, what it tells of its inputs, and what a scene gives back.

#include "vtkMRMLTissueMapperNode.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLMarkupsDisplayNode.h>
#include <vtkMRMLMarkupsFiducialNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTransformNode.h>

#include <vtkNew.h>

using Node = vtkMRMLTissueMapperNode;

namespace
{

void fill(Node* node)
{
  node->SetTrainingClass("optic \"nerve\" & <odd>");
  node->SetClasses("a \"quoted\" & <odd> name.csv");
  node->SetCorrectBias(true);
  node->SetDenoise(true);
  node->SetUseCompartments(false);
  node->SetUseContiguity(false);
  node->SetUseProximity(false);
  node->SetCompartmentsAtOnce(true);
  node->SetTargetRadius(27.5);
  node->SetRegistrationStart("principal");
  node->SetTubeName("a. carotis \"interna\"");
  node->SetMinimumRadius(0.75);
  node->SetMaximumRadius(3.5);
  node->SetPolarity("dark");
  node->SetTubePotential("gradient");
  node->SetTubeSnap(1.25);
  node->SetTubeMargin(45);
  node->SetTraceAtOnce(false);
}

int checkFilled(Node* node)
{
  CHECK_STD_STRING(node->GetTrainingClass(), "optic \"nerve\" & <odd>");
  CHECK_STD_STRING(node->GetClasses(), "a \"quoted\" & <odd> name.csv");
  CHECK_BOOL(node->GetCorrectBias(), true);
  CHECK_BOOL(node->GetDenoise(), true);
  CHECK_BOOL(node->GetUseCompartments(), false);
  CHECK_BOOL(node->GetUseContiguity(), false);
  CHECK_BOOL(node->GetUseProximity(), false);
  CHECK_BOOL(node->GetCompartmentsAtOnce(), true);
  CHECK_DOUBLE(node->GetTargetRadius(), 27.5);
  CHECK_STD_STRING(node->GetRegistrationStart(), "principal");
  CHECK_STD_STRING(node->GetTubeName(), "a. carotis \"interna\"");
  CHECK_DOUBLE(node->GetMinimumRadius(), 0.75);
  CHECK_DOUBLE(node->GetMaximumRadius(), 3.5);
  CHECK_STD_STRING(node->GetPolarity(), "dark");
  CHECK_STD_STRING(node->GetTubePotential(), "gradient");
  CHECK_DOUBLE(node->GetTubeSnap(), 1.25);
  CHECK_DOUBLE(node->GetTubeMargin(), 45);
  CHECK_BOOL(node->GetTraceAtOnce(), false);
  return EXIT_SUCCESS;
}

Node* addNode(vtkMRMLScene* scene)
{
  scene->RegisterNodeClass(vtkNew<Node>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsFiducialNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsDisplayNode>());
  return Node::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLTissueMapperNode"));
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

int checkInputs()
{
  vtkNew<vtkMRMLScene> scene;
  Node* node = addNode(scene);
  vtkMRMLNode* t1 = scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode", "T1");
  vtkMRMLNode* ct = scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode", "CT");
  auto* points = vtkMRMLMarkupsNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLMarkupsFiducialNode"));
  node->SetNode(Node::FourthImageRole(), ct);
  node->SetNode(Node::ImageRole(), t1);
  node->SetNode(Node::TrainingRole(), points);
  CHECK_INT(int(node->GetImages().size()), 2);
  CHECK_POINTER(node->GetImages()[0], t1);
  CHECK_POINTER(node->GetImages()[1], ct);
  CHECK_POINTER(node->GetMarkupsNode(Node::TrainingRole()), points);
  CHECK_POINTER(node->GetTubeImage(), t1);
  vtkMRMLNode* angiogram = scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode", "MRA");
  node->SetNode(Node::TubeImageRole(), angiogram);
  CHECK_POINTER(node->GetTubeImage(), angiogram);

  vtkNew<vtkMRMLCoreTestingUtilities::vtkMRMLNodeCallback> events;
  node->AddObserver(Node::InputModifiedEvent, events);
  points->AddControlPoint(1, 2, 3);
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true);
  events->ResetNumberOfEvents();
  points->SetNthControlPointLabel(0, "skull");
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true);
  vtkMRMLNode* transform = scene->AddNewNodeByClass("vtkMRMLTransformNode");
  for (vtkMRMLNode* image : { ct, angiogram })
  {
    events->ResetNumberOfEvents();
    vtkMRMLTransformableNode::SafeDownCast(image)->SetAndObserveTransformNodeID(transform->GetID());
    CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true);
  }

  scene->RemoveNode(t1);
  CHECK_INT(int(node->GetImages().size()), 1);
  scene->RemoveNode(points);
  CHECK_NULL(node->GetMarkupsNode(Node::TrainingRole()));
  return EXIT_SUCCESS;
}

int checkSceneRoundTrip()
{
  vtkNew<vtkMRMLScene> scene;
  Node* node = addNode(scene);
  fill(node);
  node->SetNode(Node::SecondImageRole(), scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode", "CT"));
  node->SetNode(Node::TrainingRole(), scene->AddNewNodeByClass("vtkMRMLMarkupsFiducialNode", "points"));
  scene->SetSaveToXMLString(1);
  scene->Commit();

  vtkNew<vtkMRMLScene> read;
  addNode(read);
  read->Clear(1);
  read->SetLoadFromXMLString(1);
  read->SetSceneXMLString(scene->GetSceneXMLString());
  read->Import();
  auto* restored = Node::SafeDownCast(read->GetFirstNodeByClass("vtkMRMLTissueMapperNode"));
  CHECK_NOT_NULL(restored);
  CHECK_EXIT_SUCCESS(checkFilled(restored));
  CHECK_STRING(restored->GetScalarVolumeNode(Node::SecondImageRole())->GetName(), "CT");
  CHECK_STRING(restored->GetMarkupsNode(Node::TrainingRole())->GetName(), "points");
  vtkNew<vtkMRMLCoreTestingUtilities::vtkMRMLNodeCallback> events;
  restored->AddObserver(Node::InputModifiedEvent, events);
  restored->GetMarkupsNode(Node::TrainingRole())->AddControlPoint(1, 2, 3);
  CHECK_BOOL(events->GetNumberOfEvents(Node::InputModifiedEvent) > 0, true); // inputs are observed again
  return EXIT_SUCCESS;
}

} // namespace

int vtkMRMLTissueMapperNodeTest(int, char*[])
{
  CHECK_EXIT_SUCCESS(checkValues());
  CHECK_EXIT_SUCCESS(checkInputs());
  CHECK_EXIT_SUCCESS(checkSceneRoundTrip());
  return EXIT_SUCCESS;
}
