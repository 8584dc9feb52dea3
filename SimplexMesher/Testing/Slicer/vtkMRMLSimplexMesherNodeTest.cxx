// SPDX-License-Identifier: Apache-2.0
// The parameter node: its own methods, and what a scene gives back.

#include "vtkMRMLSimplexMesherNode.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>

#include <vtkNew.h>

using Node = vtkMRMLSimplexMesherNode;
using surgicalmesher::TissueRole;
using surgicalmesher::TissueSetting;

namespace
{

const char* const awkwardId = "Segment_1|50%;7C%25 & \"<ä>\"";

TissueSetting groupSetting()
{
  TissueSetting setting;
  setting.role = TissueRole::Group;
  setting.group = "vessels; 'left' | 100 %";
  setting.minimumEdgeLength = 0.5;
  setting.maximumEdgeLength = 3.25;
  setting.isProtected = true;
  setting.islandVolume = 0;
  setting.cavityVolume = 12;
  return setting;
}

void fill(vtkMRMLSimplexMesherNode* node)
{
  node->UseScaleOff();
  node->SetEdgeLength(3.123456789);
  node->SetMinimumIslandVolume(30);
  node->SetMinimumCavityVolume(5);
  node->SetFeatureScale(0.5);
  node->SetSmoothing(0.9);
  node->SetRigidity(0.45);
  node->SetContinuity(Node::NoBend);
  node->SetMaximumDistance(1.25);
  node->SetProximityNear(0.4);
  node->SetProximityFar(2.5);
  node->SetChordError(0.15);
  node->SetBackground(77);
  node->FollowThicknessOn();
  node->SetGradation(0.4);
  node->SetThreads(3);
  node->TissueModelsOn();
  node->KeepAmbientOff();
  node->ReportOff();
  node->SetTissueSetting(awkwardId, groupSetting());
  TissueSetting left;
  left.role = TissueRole::Leave;
  node->SetTissueSetting("17", left);
  node->SetBalloonStops({ awkwardId, "5" });
  node->SetBalloonLimit(26.5);
  node->SetBalloonRigidity(3);
}

/// Whether everything is as fill() made it.
int checkFilled(vtkMRMLSimplexMesherNode* node)
{
  CHECK_BOOL(node->GetUseScale(), false);
  CHECK_DOUBLE(node->GetEdgeLength(), 3.123456789);
  CHECK_DOUBLE(node->GetMinimumIslandVolume(), 30);
  CHECK_DOUBLE(node->GetMinimumCavityVolume(), 5);
  CHECK_DOUBLE(node->GetFeatureScale(), 0.5);
  CHECK_DOUBLE(node->GetSmoothing(), 0.9);
  CHECK_DOUBLE(node->GetRigidity(), 0.45);
  CHECK_INT(node->GetContinuity(), Node::NoBend);
  CHECK_DOUBLE(node->GetMaximumDistance(), 1.25);
  CHECK_DOUBLE(node->GetProximityNear(), 0.4);
  CHECK_DOUBLE(node->GetProximityFar(), 2.5);
  CHECK_DOUBLE(node->GetChordError(), 0.15);
  CHECK_INT(node->GetBackground(), 77);
  CHECK_BOOL(node->GetFollowThickness(), true);
  CHECK_DOUBLE(node->GetGradation(), 0.4);
  CHECK_INT(node->GetThreads(), 3);
  CHECK_BOOL(node->GetTissueModels(), true);
  CHECK_BOOL(node->GetKeepAmbient(), false);
  CHECK_BOOL(node->GetReport(), false);
  CHECK_INT(int(node->GetTissueSettings().size()), 2);
  const TissueSetting setting = node->GetTissueSetting(awkwardId);
  CHECK_BOOL(setting.role == TissueRole::Group, true);
  CHECK_STD_STRING(setting.group, groupSetting().group);
  CHECK_DOUBLE(setting.minimumEdgeLength, 0.5);
  CHECK_DOUBLE(setting.maximumEdgeLength, 3.25);
  CHECK_BOOL(setting.isProtected, true);
  CHECK_DOUBLE(setting.islandVolume, 0);
  CHECK_DOUBLE(setting.cavityVolume, 12);
  CHECK_BOOL(node->GetTissueSetting("17").role == TissueRole::Leave, true);
  CHECK_BOOL(node->GetBalloonStops() == (std::set<std::string>{ awkwardId, "5" }), true);
  CHECK_DOUBLE(node->GetBalloonLimit(), 26.5);
  CHECK_DOUBLE(node->GetBalloonRigidity(), 3);
  return EXIT_SUCCESS;
}

int checkSettings()
{
  vtkNew<vtkMRMLSimplexMesherNode> node;
  vtkNew<vtkMRMLCoreTestingUtilities::vtkMRMLNodeCallback> events;
  node->AddObserver(vtkCommand::ModifiedEvent, events);
  fill(node);
  CHECK_EXIT_SUCCESS(checkFilled(node));
  events->ResetNumberOfEvents();
  node->SetContinuity(Node::Continuity_Last); // there is no such
  node->SetTissueSettings(node->GetTissueSettings());
  CHECK_INT(events->GetTotalNumberOfEvents(), 0);
  node->SetTissueSetting("17", TissueSetting()); // as it is: forgotten
  CHECK_INT(events->GetNumberOfEvents(vtkCommand::ModifiedEvent), 1);
  CHECK_INT(int(node->GetTissueSettings().size()), 1);
  vtkNew<vtkMRMLSimplexMesherNode> copy;
  fill(node);
  copy->CopyContent(node);
  return checkFilled(copy);
}

int checkSceneRoundTrip()
{
  vtkNew<vtkMRMLScene> scene;
  scene->RegisterNodeClass(vtkNew<vtkMRMLSimplexMesherNode>());
  auto* node = vtkMRMLSimplexMesherNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLSimplexMesherNode"));
  vtkMRMLNode* scale = scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode", "scale");
  vtkMRMLNode* surface = scene->AddNewNodeByClass("vtkMRMLModelNode", "surface");
  fill(node);
  node->SetNode(vtkMRMLSimplexMesherNode::ScaleRole(), scale);
  node->SetNode(vtkMRMLSimplexMesherNode::SurfaceRole(), surface);
  scene->SetSaveToXMLString(1);
  scene->Commit();

  vtkNew<vtkMRMLScene> read;
  read->RegisterNodeClass(vtkNew<vtkMRMLSimplexMesherNode>());
  read->SetLoadFromXMLString(1);
  read->SetSceneXMLString(scene->GetSceneXMLString());
  read->Import();
  auto* restored = vtkMRMLSimplexMesherNode::SafeDownCast(read->GetFirstNodeByClass("vtkMRMLSimplexMesherNode"));
  CHECK_NOT_NULL(restored);
  CHECK_EXIT_SUCCESS(checkFilled(restored));
  CHECK_STRING(restored->GetScalarVolumeNode(Node::ScaleRole())->GetName(), "scale");
  CHECK_STRING(restored->GetModelNode(Node::SurfaceRole())->GetName(), "surface");
  CHECK_NULL(restored->GetLabelMapNode(Node::PreparedLabelMapRole()));
  restored->SetNode(vtkMRMLSimplexMesherNode::ScaleRole(), nullptr);
  CHECK_NULL(restored->GetScalarVolumeNode(Node::ScaleRole()));
  return EXIT_SUCCESS;
}

/// The values that fill() sets and a role, as version 0.1 has written them.
int checkSavedScene()
{
  vtkNew<vtkMRMLScene> scene;
  scene->RegisterNodeClass(vtkNew<vtkMRMLSimplexMesherNode>());
  scene->SetLoadFromXMLString(1);
  scene->SetSceneXMLString(
    R"(<MRML version="Slicer5.0.3" userTags=""><Model id="vtkMRMLModelNode1" name="surface"></Model>
<SimplexMesher id="vtkMRMLSimplexMesherNode1" name="SimplexMesher" hideFromEditors="true"
 references="surface:vtkMRMLModelNode1;" useScale="false" edgeLength="3.123456789" minimumIslandVolume="30"
 minimumCavityVolume="5" featureScale="0.5" smoothing="0.9" rigidity="0.45" continuity="C1" maximumDistance="1.25"
 proximityNear="0.4" proximityFar="2.5" chordError="0.15" background="77" followThickness="true" gradation="0.4" threads="3"
 tissueModels="true" keepAmbient="false" report="false"
 tissues="17|leave||0|0|no|-1|-1;Segment_1%7C50%25%3B7C%2525 &amp; &quot;&lt;ä&gt;&quot;|)"
    R"(group|vessels%3B 'left' %7C 100 %25|0.5|3.25|yes|0|12;"
 balloonStops="5;Segment_1%7C50%25%3B7C%2525 &amp; &quot;&lt;ä&gt;&quot;;" balloonLimit="26.5"
 balloonRigidity="3"></SimplexMesher></MRML>)");
  scene->Import();
  auto* node = Node::SafeDownCast(scene->GetFirstNodeByClass("vtkMRMLSimplexMesherNode"));
  CHECK_NOT_NULL(node);
  CHECK_STRING(node->GetModelNode(Node::SurfaceRole())->GetName(), "surface");
  return checkFilled(node);
}

/// A scene that was saved before there were a smooth boundary and its forces.
int checkOlderScene()
{
  vtkNew<vtkMRMLScene> scene;
  scene->RegisterNodeClass(vtkNew<vtkMRMLSimplexMesherNode>());
  scene->SetLoadFromXMLString(1);
  scene->SetSceneXMLString(
    R"(<MRML version="Slicer5.0.3" userTags=""><SimplexMesher id="vtkMRMLSimplexMesherNode1" name="SimplexMesher"
 hideFromEditors="true" useScale="false" edgeLength="3" maximumDistance="1.25"></SimplexMesher></MRML>)");
  scene->Import();
  auto* node = Node::SafeDownCast(scene->GetFirstNodeByClass("vtkMRMLSimplexMesherNode"));
  CHECK_NOT_NULL(node);
  CHECK_DOUBLE(node->GetMaximumDistance(), 1.25);
  CHECK_DOUBLE(node->GetSmoothing(), 0.7);
  CHECK_DOUBLE(node->GetRigidity(), 0.28);
  CHECK_INT(node->GetContinuity(), Node::MeanCurvature);
  CHECK_DOUBLE(node->GetProximityFar(), 0);
  CHECK_DOUBLE(node->GetChordError(), 0);
  CHECK_INT(node->GetBackground(), 0);
  return EXIT_SUCCESS;
}

} // namespace

int vtkMRMLSimplexMesherNodeTest(int, char*[])
{
  vtkNew<vtkMRMLSimplexMesherNode> node;
  EXERCISE_ALL_BASIC_MRML_METHODS(node.GetPointer());
  CHECK_EXIT_SUCCESS(checkSettings());
  CHECK_EXIT_SUCCESS(checkSceneRoundTrip());
  CHECK_EXIT_SUCCESS(checkSavedScene());
  CHECK_EXIT_SUCCESS(checkOlderScene());
  return EXIT_SUCCESS;
}
