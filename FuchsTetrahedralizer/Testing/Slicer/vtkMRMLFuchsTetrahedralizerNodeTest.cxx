// SPDX-License-Identifier: Apache-2.0
// The parameter node: what it holds survives a scene's file and a copy, and it tells of changes once.

#include "vtkMRMLFuchsTetrahedralizerNode.h"
#include "MeshComparison.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <vtkCallbackCommand.h>
#include <vtkNew.h>

namespace
{

using Node = vtkMRMLFuchsTetrahedralizerNode;

void fill(Node* node)
{
  node->SetEdgeLengthSource(Node::Uniform);
  node->SetEdgeLength(3.123456789);
  node->UseAmbientOff();
  node->SetShellTissues("dura mater, \"falx\" & <tentorium>:outside");
  node->SetShellThickness(0.5);
  node->SetMaterialsFile("/data/materials of the head.csv");
  node->SetNonlinearDistance(25);
  node->SetNonlinearDistanceAtTarget(8);
  node->SetNullDisplacementRadius(60);
  node->SetNullDisplacementPathDistance(40);
  node->SetNullDisplacementPathDistanceAtTarget(10);
  node->ConditioningOn();
  node->SetFeatureAngle(55);
  node->SetThreads(3);
  node->SetExportElements(Node::TenNodesCurved);
  node->SetExportUnits(Node::SI);
  node->SetColorBy(Node::MinimumDihedralAngle);
  node->SetClipPlane(Node::Sagittal);
  node->ClipFlippedOn();
  node->ShowEdgesOff();
}

int checkFilled(Node* node)
{
  CHECK_INT(node->GetEdgeLengthSource(), Node::Uniform);
  CHECK_DOUBLE(node->GetEdgeLength(), 3.123456789);
  CHECK_BOOL(node->GetUseAmbient(), false);
  CHECK_STD_STRING(node->GetShellTissues(), "dura mater, \"falx\" & <tentorium>:outside");
  CHECK_DOUBLE(node->GetShellThickness(), 0.5);
  CHECK_STD_STRING(node->GetMaterialsFile(), "/data/materials of the head.csv");
  CHECK_DOUBLE(node->GetNonlinearDistance(), 25);
  CHECK_DOUBLE(node->GetNonlinearDistanceAtTarget(), 8);
  CHECK_DOUBLE(node->GetNullDisplacementRadius(), 60);
  CHECK_DOUBLE(node->GetNullDisplacementPathDistance(), 40);
  CHECK_DOUBLE(node->GetNullDisplacementPathDistanceAtTarget(), 10);
  CHECK_BOOL(node->GetConditioning(), true);
  CHECK_DOUBLE(node->GetFeatureAngle(), 55);
  CHECK_INT(node->GetThreads(), 3);
  CHECK_INT(node->GetExportElements(), Node::TenNodesCurved);
  CHECK_INT(node->GetExportUnits(), Node::SI);
  CHECK_INT(node->GetColorBy(), Node::MinimumDihedralAngle);
  CHECK_INT(node->GetClipPlane(), Node::Sagittal);
  CHECK_BOOL(node->GetClipFlipped(), true);
  CHECK_BOOL(node->GetShowEdges(), false);
  return EXIT_SUCCESS;
}

int testSceneFile()
{
  const std::string file = surgicalmesher::test::newFolder("vtkMRMLFuchsTetrahedralizerNodeTest") + "/scene.mrml";
  vtkNew<vtkMRMLScene> saved;
  saved->RegisterNodeClass(vtkNew<Node>());
  auto* node = Node::SafeDownCast(saved->AddNewNodeByClass("vtkMRMLFuchsTetrahedralizerNode"));
  vtkMRMLNode* first = saved->AddNewNodeByClass("vtkMRMLModelNode", "first");
  vtkMRMLNode* second = saved->AddNewNodeByClass("vtkMRMLModelNode", "second");
  vtkMRMLNode* mesh = saved->AddNewNodeByClass("vtkMRMLModelNode", "mesh");
  fill(node);
  node->SetNodes(Node::SurfaceRole(), { first, second });
  node->SetNode(Node::MeshRole(), mesh);
  saved->SetURL(file.c_str());
  CHECK_INT(saved->Commit(), 1);

  vtkNew<vtkMRMLScene> restored;
  restored->RegisterNodeClass(vtkNew<Node>());
  restored->SetURL(file.c_str());
  CHECK_INT(restored->Import(), 1);
  auto* again = Node::SafeDownCast(restored->GetFirstNodeByClass("vtkMRMLFuchsTetrahedralizerNode"));
  CHECK_NOT_NULL(again);
  CHECK_EXIT_SUCCESS(checkFilled(again));
  const std::vector<vtkMRMLNode*> surfaces = again->GetNodes(Node::SurfaceRole());
  CHECK_INT(surfaces.size(), 2);
  CHECK_STRING(surfaces[0]->GetName(), "first");
  CHECK_STRING(surfaces[1]->GetName(), "second");
  CHECK_STRING(again->GetModelNode(Node::MeshRole())->GetName(), "mesh");
  CHECK_NULL(again->GetModelNode(Node::ChildMeshRole()));
  return EXIT_SUCCESS;
}

/// The values that fill() sets and a role of two nodes, as version 0.1 has written them.
int testSavedScene()
{
  vtkNew<vtkMRMLScene> scene;
  scene->RegisterNodeClass(vtkNew<Node>());
  scene->SetLoadFromXMLString(1);
  scene->SetSceneXMLString(
    R"(<MRML version="Slicer5.0.3" userTags=""><Model id="vtkMRMLModelNode1" name="first"></Model>
<Model id="vtkMRMLModelNode2" name="second"></Model>
<FuchsTetrahedralizer id="vtkMRMLFuchsTetrahedralizerNode1" name="FuchsTetrahedralizer" hideFromEditors="true"
 references="surface:vtkMRMLModelNode1 vtkMRMLModelNode2;" edgeLengthSource="uniform" edgeLength="3.123456789"
 useAmbient="false" shellTissues="dura mater, &quot;falx&quot; &amp; &lt;tentorium&gt;:outside" shellThickness="0.5"
 materialsFile="/data/materials of the head.csv" nonlinearDistance="25" nonlinearDistanceAtTarget="8"
 nullDisplacementRadius="60"
 nullDisplacementPathDistance="40" nullDisplacementPathDistanceAtTarget="10" conditioning="true" featureAngle="55" threads="3"
 exportElements="tenNodesCurved" exportUnits="si"
 colorBy="minimumDihedralAngle" clipPlane="sagittal" clipFlipped="true"
 showEdges="false"></FuchsTetrahedralizer></MRML>)");
  CHECK_INT(scene->Import(), 1);
  auto* node = Node::SafeDownCast(scene->GetFirstNodeByClass("vtkMRMLFuchsTetrahedralizerNode"));
  CHECK_NOT_NULL(node);
  CHECK_INT(node->GetNodes(Node::SurfaceRole()).size(), 2);
  return checkFilled(node);
}

int testCopyAndRefusals()
{
  vtkNew<Node> node, copy;
  fill(node);
  copy->CopyContent(node);
  CHECK_EXIT_SUCCESS(checkFilled(copy));
  copy->SetEdgeLengthSource(17);
  copy->SetColorBy(-1);
  copy->SetExportElements(Node::ExportElements_Last);
  copy->SetExportUnits(-1);
  copy->SetClipPlane(Node::ClipPlane_Last);
  CHECK_EXIT_SUCCESS(checkFilled(copy));
  const char* unknown[] = { "colorBy", "no such thing", "threads", "many", nullptr };
  TESTING_OUTPUT_ASSERT_ERRORS_BEGIN();
  copy->ReadXMLAttributes(unknown);
  TESTING_OUTPUT_ASSERT_ERRORS_END();
  CHECK_EXIT_SUCCESS(checkFilled(copy));
  return EXIT_SUCCESS;
}

int testEvents()
{
  vtkNew<vtkMRMLScene> scene;
  scene->RegisterNodeClass(vtkNew<Node>());
  auto* node = Node::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLFuchsTetrahedralizerNode"));
  vtkMRMLNode* surface = scene->AddNewNodeByClass("vtkMRMLModelNode");
  int modified = 0;
  vtkNew<vtkCallbackCommand> onModified;
  onModified->SetClientData(&modified);
  onModified->SetCallback([](vtkObject*, unsigned long, void* counter, void*) { ++*static_cast<int*>(counter); });
  node->AddObserver(vtkCommand::ModifiedEvent, onModified);

  node->SetEdgeLength(4);
  CHECK_INT(modified, 1);
  node->SetEdgeLength(4);
  CHECK_INT(modified, 1);
  node->SetNode(Node::SurfaceRole(), surface);
  CHECK_INT(modified, 2);
  node->SetNode(Node::SurfaceRole(), surface);
  CHECK_INT(modified, 2);
  node->SetNode(Node::MeshRole(), surface); // a wrong state, but no reason for the host to warn
  CHECK_INT(modified, 3);
  scene->RemoveNode(surface);
  CHECK_INT(node->GetNodes(Node::SurfaceRole()).size(), 0);
  return EXIT_SUCCESS;
}

} // namespace

int vtkMRMLFuchsTetrahedralizerNodeTest(int, char*[])
{
  vtkNew<Node> node;
  EXERCISE_ALL_BASIC_MRML_METHODS(node.GetPointer());
  CHECK_EXIT_SUCCESS(testSceneFile());
  CHECK_EXIT_SUCCESS(testSavedScene());
  CHECK_EXIT_SUCCESS(testCopyAndRefusals());
  CHECK_EXIT_SUCCESS(testEvents());
  return EXIT_SUCCESS;
}
