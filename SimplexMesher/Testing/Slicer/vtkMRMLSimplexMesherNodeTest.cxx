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
  node->SetMaximumDistance(1.25);
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
}

/// Whether everything is as fill() made it.
int checkFilled(vtkMRMLSimplexMesherNode* node)
{
  CHECK_BOOL(node->GetUseScale(), false);
  CHECK_DOUBLE(node->GetEdgeLength(), 3.123456789);
  CHECK_DOUBLE(node->GetMinimumIslandVolume(), 30);
  CHECK_DOUBLE(node->GetMinimumCavityVolume(), 5);
  CHECK_DOUBLE(node->GetFeatureScale(), 0.5);
  CHECK_DOUBLE(node->GetMaximumDistance(), 1.25);
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

} // namespace

int vtkMRMLSimplexMesherNodeTest(int, char*[])
{
  vtkNew<vtkMRMLSimplexMesherNode> node;
  EXERCISE_ALL_BASIC_MRML_METHODS(node.GetPointer());
  CHECK_EXIT_SUCCESS(checkSettings());
  CHECK_EXIT_SUCCESS(checkSceneRoundTrip());
  return EXIT_SUCCESS;
}
