// SPDX-License-Identifier: Apache-2.0
#include "MeshedBalls.h"

#include "HostScene.h"
#include "MeshComparison.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLStorageNode.h>

#include <vtkNew.h>
#include <vtkSphereSource.h>

#include <stdexcept>

namespace surgicalmesher::test
{
namespace
{

template <class Node>
Node* load(vtkMRMLScene* scene, const std::string& file, const char* className, const char* name)
{
  auto* node = Node::SafeDownCast(scene->AddNewNodeByClass(className, name));
  node->AddDefaultStorageNode();
  node->GetStorageNode()->SetFileName(file.c_str());
  if (!node->GetStorageNode()->ReadData(node)) throw std::runtime_error(file + " can't be read");
  node->CreateDefaultDisplayNodes();
  return node;
}

void removeWithStorage(vtkMRMLScene* scene, vtkMRMLStorableNode* node)
{
  scene->RemoveNode(node->GetStorageNode());
  scene->RemoveNode(node);
}

} // namespace

MeshedBalls meshBalls(vtkMRMLScene* scene, const std::string& testName)
{
  MeshedBalls balls;
  balls.folder = newFolder(testName);
  balls.map = balls.folder + "/map.nrrd";
  balls.scale = balls.folder + "/scale.nrrd";
  balls.surface = balls.folder + "/surface.vtp";
  balls.ambient = balls.folder + "/ambient.vtu";
  vtkMRMLLabelMapVolumeNode* map = addNestedBalls(scene);
  map->AddDefaultStorageNode();
  map->GetStorageNode()->SetFileName(balls.map.c_str());
  if (!map->GetStorageNode()->WriteData(map)) throw std::runtime_error(balls.map + " can't be written");
  removeWithStorage(scene, map);
  runCommandLine("SurgicalPathScaleCLI",
                 { "--targetPoint", "0,0,0", "--minimumEdgeLength", "1.5", "--maximumEdgeLength", "4", "--childRadius",
                   "4", "--decayLength", "8", "--spacing", "1", balls.map, balls.scale });
  runCommandLine("SimplexMesherCLI", { "--scale", balls.scale, "--ambient", balls.ambient, balls.map, balls.surface });
  return balls;
}

vtkMRMLModelNode* loadModel(vtkMRMLScene* scene, const std::string& file, const char* name)
{
  return load<vtkMRMLModelNode>(scene, file, "vtkMRMLModelNode", name);
}

vtkMRMLScalarVolumeNode* loadVolume(vtkMRMLScene* scene, const std::string& file, const char* name)
{
  return load<vtkMRMLScalarVolumeNode>(scene, file, "vtkMRMLScalarVolumeNode", name);
}

vtkMRMLModelNode* loadSurface(vtkMRMLScene* scene, const MeshedBalls& balls)
{
  vtkMRMLModelNode* surface = loadModel(scene, balls.surface, "surface");
  vtkMRMLModelNode* ambient = loadModel(scene, balls.ambient, "ambient");
  ambient->SetHideFromEditors(true);
  ambient->SetDisplayVisibility(false);
  surface->SetNodeReferenceID(vtkMRMLFuchsTetrahedralizerNode::AmbientTetrahedraRole(), ambient->GetID());
  return surface;
}

vtkMRMLModelNode* addClosedBall(vtkMRMLScene* scene, const char* name, double radius)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(24);
  ball->SetPhiResolution(16);
  ball->Update();
  auto* model = vtkMRMLModelNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLModelNode", name));
  model->SetAndObserveMesh(ball->GetOutput());
  model->CreateDefaultDisplayNodes();
  return model;
}

} // namespace surgicalmesher::test
