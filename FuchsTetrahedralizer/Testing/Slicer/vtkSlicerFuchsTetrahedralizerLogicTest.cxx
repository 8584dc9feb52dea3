// SPDX-License-Identifier: Apache-2.0
// The logic without its panel: closed models, transforms, constitutive classes, meshes from elsewhere, and what a saved
// scene brings back.

#include "vtkSlicerFuchsTetrahedralizerLogic.h"
#include "HostApplication.h"
#include "HostScene.h"
#include "MeshComparison.h"
#include "MeshIO.h"
#include "MeshedBalls.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"
#include "vtkSurgicalMesherRun.h"

#include <qSlicerApplication.h>

#include <vtkMRMLColorNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLinearTransformNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTableNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLFuchsTetrahedralizerNode;
using Logic = vtkSlicerFuchsTetrahedralizerLogic;

namespace
{

constexpr double PI = 3.14159265358979323846;

vtkMRMLModelNode* run(Logic* logic, Node* node)
{
  node->SetNode(Node::MeshRole(), nullptr);
  if (!logic->StartAndWait(node)) throw std::runtime_error("not started: " + logic->GetRun()->GetErrorText());
  if (logic->GetRun()->GetStatus() != vtkSurgicalMesherRun::Completed)
    throw std::runtime_error(logic->GetRun()->GetErrorText());
  return node->GetModelNode(Node::MeshRole());
}

MeshFile contentOf(vtkMRMLModelNode* mesh) { return meshOfGrid(mesh->GetUnstructuredGrid(), true, mesh->GetName()); }

std::map<Label, double> volumesOf(const MeshFile& content)
{
  std::map<Label, double> volumes;
  for (std::size_t t = 0; t < content.mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = content.mesh.tetrahedra[t];
    const std::vector<Vec3>& p = content.mesh.points;
    volumes[content.mesh.labels[t]] += orient(p[a], p[b], p[c], p[d]) / 6;
  }
  return volumes;
}

/// A host without the command-line module: the problem says so, and nothing starts.
int testWithoutModule()
{
  vtkNew<vtkMRMLScene> scene;
  vtkNew<Logic> logic;
  logic->SetMRMLScene(scene);
  Node* node = logic->ParameterNode();
  CHECK_INT(int(logic->FindProblem(node).problem), int(Logic::Problem::NoSurface));
  node->SetNode(Node::SurfaceRole(), addClosedBall(scene, "ball", 5));
  node->SetEdgeLengthSource(Node::Uniform);
  CHECK_INT(int(logic->FindProblem(node).problem), int(Logic::Problem::NoModule));
  CHECK_BOOL(logic->Start(node), false);
  node->SetEdgeLength(0);
  CHECK_INT(int(logic->FindProblem(node).problem), int(Logic::Problem::NoEdgeLength));
  CHECK_NULL(logic->GetClipSlice(node));
  CHECK_BOOL(logic->UpdateDisplay(node), false);
  return EXIT_SUCCESS;
}

/// Each closed model is a tissue of its name, the inner one within the outer.
int testClosedModels(Logic* logic, vtkMRMLScene* scene)
{
  Node* node = logic->ParameterNode();
  vtkMRMLModelNode* outer = addClosedBall(scene, "skull", 10);
  vtkMRMLModelNode* inner = addClosedBall(scene, "brain", 6);
  inner->GetDisplayNode()->SetColor(1, 0, 0);
  node->SetNodes(Node::SurfaceRole(), { outer, inner });
  node->SetEdgeLengthSource(Node::Uniform);
  node->SetEdgeLength(3);
  const MeshFile content = contentOf(run(logic, node));
  CHECK_STD_STRING(content.tissues.at(1).name, "skull");
  CHECK_STD_STRING(content.tissues.at(2).name, "brain");
  CHECK_DOUBLE(content.tissues.at(2).color[0], 1);
  CHECK_DOUBLE(content.tissues.at(2).color[1], 0);
  const auto volumes = volumesOf(content);
  const double ball = 4 * PI / 3;
  CHECK_DOUBLE_TOLERANCE(volumes.at(2), ball * 216, 0.1 * ball * 216);
  CHECK_DOUBLE_TOLERANCE(volumes.at(1), ball * 784, 0.1 * ball * 784);
  return EXIT_SUCCESS;
}

double distanceFrom(const MeshFile& content, const Vec3& place)
{
  Vec3 centre;
  for (const Vec3& p : content.mesh.points) centre = centre + p / double(content.mesh.points.size());
  return norm(centre - place);
}

/// A surface under a transform is meshed where it is seen, with its ambient tetrahedra, also in a mirror.
int testTransforms(Logic* logic, vtkMRMLScene* scene, const MeshedBalls& balls)
{
  Node* node = logic->ParameterNode();
  vtkMRMLModelNode* surface = loadSurface(scene, balls);
  node->SetNode(Node::SurfaceRole(), surface);
  node->SetEdgeLengthSource(Node::FromSurface);
  const auto straight = volumesOf(contentOf(run(logic, node)));

  surface->SetAndObserveTransformNodeID(addTransform(scene)->GetID()); // to (5, -3, 2), RAS
  const MeshFile moved = contentOf(run(logic, node));
  CHECK_DOUBLE_TOLERANCE(distanceFrom(moved, { -5, 3, 2 }), 0, 0.5);
  for (const auto& [label, volume] : volumesOf(moved))
    CHECK_DOUBLE_TOLERANCE(volume, straight.at(label), 0.02 * volume);

  auto* mirror = vtkMRMLTransformNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLLinearTransformNode"));
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 0, -1);
  matrix->SetElement(2, 3, 7);
  mirror->SetMatrixTransformToParent(matrix);
  surface->SetAndObserveTransformNodeID(mirror->GetID());
  const MeshFile mirrored = contentOf(run(logic, node)); // refuses tetrahedra that are inverted
  CHECK_DOUBLE_TOLERANCE(distanceFrom(mirrored, { 0, 0, 7 }), 0, 0.5);
  for (const auto& [label, volume] : volumesOf(mirrored))
    CHECK_DOUBLE_TOLERANCE(volume, straight.at(label), 0.02 * volume);
  surface->SetAndObserveTransformNodeID(nullptr);
  return EXIT_SUCCESS;
}

/// Targets and paths go to the module as a file of the same points would.
int testConstitutiveClasses(Logic* logic, vtkMRMLScene* scene, const MeshedBalls& balls)
{
  Node* node = logic->ParameterNode();
  node->SetNode(Node::SurfaceRole(), loadSurface(scene, balls));
  node->SetEdgeLengthSource(Node::FromSurface);
  node->SetNode(Node::TargetRole(), addMarkups(scene, "vtkMRMLMarkupsFiducialNode", { { 1, 2, 3 } }));
  node->SetNode(Node::PathRole(), addMarkups(scene, "vtkMRMLMarkupsLineNode", { { 0, 20, 0 }, { 1, 2, 3 } }));
  node->SetNonlinearDistance(4);
  node->SetNullDisplacementRadius(8);
  node->SetNullDisplacementPathDistance(6);
  node->SetNullDisplacementPathDistanceAtTarget(5);
  vtkMRMLModelNode* mesh = run(logic, node);
  const std::string file = balls.folder + "/classes.vtu";
  runCommandLine("FuchsTetrahedralizerCLI",
                 { "--ambient", balls.ambient, "--targetPoint=-1,-2,3", "--pathPoint=0,-20,0", "--pathPoint=-1,-2,3",
                   "--nonlinearDistance", "4", "--nullDisplacementRadius", "8", "--nullDisplacementPathDistance", "6",
                   "--nullDisplacementPathDistanceAtTarget", "5", balls.surface, file });
  CHECK_STD_STRING(differenceOf(file, mesh), "");
  const double* range = mesh->GetMesh()->GetCellData()->GetArray("Constitutive")->GetRange();
  CHECK_DOUBLE(range[0], 0);
  CHECK_DOUBLE(range[1], 2);
  node->SetNode(Node::TargetRole(), nullptr);
  node->SetNode(Node::PathRole(), nullptr);
  node->SetNonlinearDistance(0);
  node->SetNullDisplacementRadius(0);
  node->SetNullDisplacementPathDistance(0);
  node->SetNullDisplacementPathDistanceAtTarget(0);
  return EXIT_SUCCESS;
}

/// Tetrahedra from a file are coloured, measured and exported like those of a run.
int testMeshFromElsewhere(Logic* logic, vtkMRMLScene* scene, const MeshedBalls& balls)
{
  Node* node = logic->ParameterNode();
  vtkMRMLModelNode* mesh = loadModel(scene, balls.folder + "/classes.vtu", "elsewhere");
  node->SetNode(Node::MeshRole(), mesh);
  node->SetColorBy(Node::RadiusRatio);
  CHECK_BOOL(logic->UpdateDisplay(node), true);
  CHECK_STD_STRING(logic->Assess(mesh), "");
  CHECK_INT(std::stoi(Logic::GetQualityTable(mesh)->GetCellText(0, 1)), mesh->GetMesh()->GetNumberOfCells());
  CHECK_NOT_NULL(Logic::GetHistogram(mesh, Logic::RadiusRatios));
  CHECK_STD_STRING(logic->Export(node, balls.folder + "/elsewhere.feb"), "");

  vtkMRMLModelNode* ambient = loadModel(scene, balls.ambient, "ambient"); // without sub-meshes
  node->SetNode(Node::MeshRole(), ambient);
  node->SetColorBy(Node::SubMesh);
  CHECK_BOOL(logic->UpdateDisplay(node), false);
  vtkMRMLModelNode* ball = addClosedBall(scene, "no mesh", 3);
  node->SetNode(Node::MeshRole(), ball);
  CHECK_BOOL(logic->UpdateDisplay(node), false);
  CHECK_BOOL(logic->Assess(ball).empty(), false);
  CHECK_BOOL(logic->Export(node, balls.folder + "/no.feb").empty(), false);
  return EXIT_SUCCESS;
}

/// The mesh of a saved scene has its colours, its table and its plots, and the parameter node knows all of them.
int testScene(Logic* logic, vtkMRMLScene* scene, const MeshedBalls& balls)
{
  Node* node = logic->ParameterNode();
  node->SetNode(Node::MeshRole(), scene->GetFirstNodeByName("elsewhere"));
  node->SetColorBy(Node::MinimumDihedralAngle);
  CHECK_BOOL(logic->UpdateDisplay(node), true);
  const std::string folder = newFolder("vtkSlicerFuchsTetrahedralizerLogicTest/scene");
  const int cells = node->GetModelNode(Node::MeshRole())->GetMesh()->GetNumberOfCells();
  scene->SetRootDirectory(folder.c_str());
  CHECK_BOOL(scene->SaveSceneToSlicerDataBundleDirectory(folder.c_str()), true);
  scene->Clear(0);
  scene->SetURL((folder + "/scene.mrml").c_str());
  CHECK_INT(scene->Connect(), 1);

  node = logic->ParameterNode();
  CHECK_INT(scene->GetNumberOfNodesByClass("vtkMRMLFuchsTetrahedralizerNode"), 1);
  CHECK_INT(node->GetColorBy(), Node::MinimumDihedralAngle);
  vtkMRMLModelNode* mesh = node->GetModelNode(Node::MeshRole());
  CHECK_BOOL(Logic::IsMesh(mesh), true);
  CHECK_INT(mesh->GetMesh()->GetNumberOfCells(), cells);
  CHECK_STRING(mesh->GetModelDisplayNode()->GetActiveScalarName(), "MinimumDihedralAngle");
  CHECK_NOT_NULL(mesh->GetModelDisplayNode()->GetColorNode());
  CHECK_INT(std::stoi(Logic::GetQualityTable(mesh)->GetCellText(0, 1)), cells);
  for (int n = 0; n < Logic::Histogram_Last; ++n) CHECK_NOT_NULL(Logic::GetHistogram(mesh, n));
  CHECK_STD_STRING(logic->Export(node, balls.folder + "/restored.inp"), "");
  return EXIT_SUCCESS;
}

int testLogic()
{
  HostApplication host;
  auto* logic = Logic::SafeDownCast(host.logic("FuchsTetrahedralizer"));
  vtkMRMLScene* scene = host.scene();
  const MeshedBalls balls = meshBalls(scene, "vtkSlicerFuchsTetrahedralizerLogicTest");
  CHECK_EXIT_SUCCESS(testWithoutModule());
  CHECK_EXIT_SUCCESS(testClosedModels(logic, scene));
  CHECK_EXIT_SUCCESS(testTransforms(logic, scene, balls));
  CHECK_EXIT_SUCCESS(testConstitutiveClasses(logic, scene, balls));
  CHECK_EXIT_SUCCESS(testMeshFromElsewhere(logic, scene, balls));
  CHECK_EXIT_SUCCESS(testScene(logic, scene, balls));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

} // namespace

int vtkSlicerFuchsTetrahedralizerLogicTest(int, char*[])
{
  try
  {
    return testLogic();
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
