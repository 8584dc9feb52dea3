// SPDX-License-Identifier: Apache-2.0
/// From label map to mesh by the three panels' logics, each taking the node that the one before it left in the scene: the
/// bytes are those of the three programs in a row, each taking the file that the one before it wrote.

#include "HostApplication.h"
#include "HostDifferences.h"
#include "HostScene.h"
#include "MeshComparison.h"
#include "MeshIO.h"
#include "TissueMapIO.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"
#include "vtkMRMLSimplexMesherNode.h"
#include "vtkMRMLSurgicalPathScaleNode.h"
#include "vtkSlicerFuchsTetrahedralizerLogic.h"
#include "vtkSlicerSimplexMesherLogic.h"
#include "vtkSlicerSurgicalPathScaleLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>

#include <vtkNew.h>

#include <cmath>
#include <stdexcept>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using ScaleNode = vtkMRMLSurgicalPathScaleNode;
using SurfaceNode = vtkMRMLSimplexMesherNode;
using MeshNode = vtkMRMLFuchsTetrahedralizerNode;

namespace
{

constexpr int LARGEST_LABEL = 255;
constexpr int SKIPPED = 77;

vtkMRMLColorTableNode* addColors(vtkMRMLScene* scene)
{
  vtkNew<vtkMRMLColorTableNode> colors;
  colors->SetTypeToUser();
  colors->SetName("Areas");
  colors->SetNumberOfColors(LARGEST_LABEL + 1);
  host::keepColorNames(colors.GetPointer());
  colors->SetColor(0, "background", 0, 0, 0, 0);
  for (int label = 1; label <= LARGEST_LABEL; ++label)
    colors->SetColor(label, ("area " + std::to_string(label)).c_str(), label % 5 / 4.0, label % 7 / 6.0,
                     label % 3 / 2.0);
  return vtkMRMLColorTableNode::SafeDownCast(scene->AddNode(colors));
}

/// The atlas's tissues within 16 mm of its origin, which is its own.
vtkMRMLLabelMapVolumeNode* addAtlasPiece(vtkMRMLScene* scene)
{
  const TissueMap atlas = readTissueMap(jhuAtlasFile()); // voxels of 1 mm
  const auto labelAt = [&](const Point& p)
  {
    const Vec3 place = atlas.grid.worldToGrid({ -p[0], -p[1], p[2] });
    return int(surgicalmesher::labelAt(
      atlas, { int(std::lround(place.x)), int(std::lround(place.y)), int(std::lround(place.z)) }));
  };
  vtkMRMLLabelMapVolumeNode* piece = addLabelMap(scene, "Piece", 33, 1, labelAt);
  piece->GetDisplayNode()->SetAndObserveColorNodeID(addColors(scene)->GetID());
  return piece;
}

template <class Logic, class Node>
void runToEnd(Logic* logic, Node* node)
{
  if (logic->StartAndWait(node) && logic->GetRun()->GetStatus() == vtkSurgicalMesherRun::Completed) return;
  throw std::runtime_error(std::string(node->GetClassName()) + ": " + logic->GetRun()->GetErrorText());
}

template <class Logic>
Logic* logicOf(HostApplication& host, const char* module)
{
  return Logic::SafeDownCast(host.logic(module));
}

vtkMRMLScalarVolumeNode* scaleOfPanel(HostApplication& host, vtkMRMLNode* map)
{
  auto* logic = logicOf<vtkSlicerSurgicalPathScaleLogic>(host, "SurgicalPathScale");
  ScaleNode* node = logic->ParameterNode();
  node->SetNode(ScaleNode::TissueMapRole(), map);
  node->SetNode(ScaleNode::TargetsRole(), addMarkups(host.scene(), "vtkMRMLMarkupsFiducialNode", { { 4, -12, -7 } }));
  node->SetMinimumEdgeLength(3);
  node->SetMaximumEdgeLength(6);
  node->SetChildRadius(4);
  runToEnd(logic, node);
  return vtkMRMLScalarVolumeNode::SafeDownCast(node->GetNodeReference(ScaleNode::ScaleRole()));
}

vtkMRMLModelNode* surfaceOfPanel(HostApplication& host, vtkMRMLNode* map, vtkMRMLNode* scale)
{
  auto* logic = logicOf<vtkSlicerSimplexMesherLogic>(host, "SimplexMesher");
  SurfaceNode* node = logic->ParameterNode();
  node->SetNode(SurfaceNode::TissueMapRole(), map);
  node->SetNode(SurfaceNode::ScaleRole(), scale);
  node->SetMinimumIslandVolume(30);
  runToEnd(logic, node);
  return node->GetModelNode(SurfaceNode::SurfaceRole());
}

vtkMRMLModelNode* meshOfPanel(HostApplication& host, vtkMRMLNode* surface, vtkMRMLNode* scale, const std::string& file)
{
  auto* logic = logicOf<vtkSlicerFuchsTetrahedralizerLogic>(host, "FuchsTetrahedralizer");
  MeshNode* node = logic->ParameterNode();
  node->SetNode(MeshNode::SurfaceRole(), surface);
  node->SetNode(MeshNode::ScaleRole(), scale);
  node->SetEdgeLengthSource(MeshNode::FromScale);
  runToEnd(logic, node);
  if (const std::string problem = logic->Export(node, file); !problem.empty()) throw std::runtime_error(problem);
  return node->GetModelNode(MeshNode::MeshRole());
}

struct ProgramFiles
{
  std::string map, names, scale, surface, ambient, mesh, exported;
};

ProgramFiles runPrograms(const std::string& folder, vtkMRMLLabelMapVolumeNode* map)
{
  const auto in = [&](const char* name) { return folder + "/" + name; };
  ProgramFiles files{ savedByHost(map, in("map.nrrd")),
                      savedByHost(map->GetDisplayNode()->GetColorNode(), in("names.ctbl")),
                      in("scale.nrrd"),
                      in("surface.vtp"),
                      in("ambient.vtu"),
                      in("mesh.vtu"),
                      in("mesh.inp") };
  runCommandLine("SurgicalPathScaleCLI", { "--targetPoint=-4,12,-7", "--minimumEdgeLength=3", "--maximumEdgeLength=6",
                                           "--childRadius=4", files.map, files.scale });
  runCommandLine("SimplexMesherCLI", { "--scale", files.scale, "--names", files.names, "--minimumIslandVolume=30",
                                       "--ambient", files.ambient, files.map, files.surface });
  runCommandLine("FuchsTetrahedralizerCLI", { "--scale", files.scale, "--ambient", files.ambient, "--export",
                                              files.exported, files.surface, files.mesh });
  return files;
}

int testScale(const ProgramFiles& files, const std::string& folder, vtkMRMLScalarVolumeNode* scale)
{
  writeScale(readScale(savedByHost(scale, folder + "/saved.nrrd")), folder + "/again.nrrd");
  CHECK_BOOL(sameBytes(files.scale, folder + "/again.nrrd"), true);
  return EXIT_SUCCESS;
}

int testSurface(const ProgramFiles& files, const std::string& folder, vtkMRMLModelNode* surface)
{
  CHECK_STD_STRING(differenceOf(files.surface, surface), "");
  auto* ambient = vtkMRMLModelNode::SafeDownCast(surface->GetNodeReference(SurfaceNode::AmbientTetrahedraRole()));
  CHECK_STD_STRING(differenceOf(files.ambient, ambient), "");
  writeSurface(readSurface(savedByHost(surface, folder + "/saved.vtp")), folder + "/again.vtp");
  CHECK_BOOL(sameBytes(files.surface, folder + "/again.vtp"), true);
  return EXIT_SUCCESS;
}

/// The host's file of the mesh has the same content in a frame and an encoding of the host's own.
int testMesh(const ProgramFiles& files, const std::string& folder, vtkMRMLModelNode* mesh)
{
  CHECK_STD_STRING(differenceOf(files.mesh, mesh), "");
  writeMesh(readMesh(savedByHost(mesh, folder + "/saved.vtu")), folder + "/again.vtu");
  CHECK_BOOL(sameBytes(files.mesh, folder + "/again.vtu"), true);
  CHECK_BOOL(sameBytes(files.exported, folder + "/panel.inp"), true);
  return EXIT_SUCCESS;
}

int testChain()
{
  HostApplication host;
  const std::string folder = newFolder("PanelChainTest");
  vtkMRMLLabelMapVolumeNode* map = addAtlasPiece(host.scene());
  const ProgramFiles files = runPrograms(folder, map);
  vtkMRMLScalarVolumeNode* scale = scaleOfPanel(host, map);
  CHECK_EXIT_SUCCESS(testScale(files, folder, scale));
  vtkMRMLModelNode* surface = surfaceOfPanel(host, map, scale);
  CHECK_EXIT_SUCCESS(testSurface(files, folder, surface));
  CHECK_EXIT_SUCCESS(testMesh(files, folder, meshOfPanel(host, surface, scale, folder + "/panel.inp")));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

} // namespace

int PanelChainTest(int, char*[])
{
  if (jhuAtlasFile().empty()) return SKIPPED; // Debian's package mricron-data
  try
  {
    return testChain();
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
