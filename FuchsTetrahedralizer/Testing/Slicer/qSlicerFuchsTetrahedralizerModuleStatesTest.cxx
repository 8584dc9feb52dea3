// SPDX-License-Identifier: Apache-2.0
// States that a run can get into: every one ends in a sentence, without a crash, a node or a file left behind.

#include "HostApplication.h"
#include "HostScene.h"
#include "MeshedBalls.h"
#include "qSurgicalMesherRunWidget.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"
#include "vtkSlicerFuchsTetrahedralizerLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerApplication.h>

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTransformNode.h>

#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <QCoreApplication>
#include <QPushButton>

#include <fstream>

using namespace surgicalmesher::test;
using Node = vtkMRMLFuchsTetrahedralizerNode;
using Logic = vtkSlicerFuchsTetrahedralizerLogic;
using Problem = Logic::Problem;

namespace
{

struct Panel
{
  HostApplication& host;
  qSlicerAbstractModuleWidget* widget = host.enterPanel("FuchsTetrahedralizer");
  Logic* logic = Logic::SafeDownCast(host.logic("FuchsTetrahedralizer"));

  Node* node() { return logic->ParameterNode(); }
  vtkSurgicalMesherRun* run() { return logic->GetRun(); }
  qSurgicalMesherRunWidget* foot() { return findChild<qSurgicalMesherRunWidget>(widget, "RunWidget"); }
  QPushButton* button(const char* name) { return findChild<QPushButton>(widget, name); }
  bool waitForEnd()
  {
    return host.waitUntil([this] { return !run()->IsBusy(); });
  }
};

/// What the host and the runs of this process left in the folder for temporary files, which other processes use too.
/// The host writes its process number in letters.
std::string filesOfRuns()
{
  std::string number = std::to_string(QCoreApplication::applicationPid()), letters;
  for (const char digit : number) letters += char('A' + digit - '0');
  std::string found;
  for (const std::string& file : temporaryFiles())
  {
    if (file.rfind(letters + "_", 0) == 0 || file.rfind("SurgicalMesher-" + number + "-", 0) == 0) found += file + "\n";
  }
  return found;
}

#define CHECK_PROBLEM(expected)                                                                                        \
  CHECK_INT(int(panel.logic->FindProblem(panel.node()).problem), int(Problem::expected));                              \
  CHECK_BOOL(panel.foot()->problem().isEmpty(), Problem::expected == Problem::None);                                   \
  CHECK_BOOL(panel.button("ApplyButton")->isEnabled(), Problem::expected == Problem::None)

/// The button mends what is wrong; of some problems it can't.
#define CHECK_FIXED(expected)                                                                                          \
  CHECK_PROBLEM(expected);                                                                                             \
  panel.button("FixButton")->click();                                                                                  \
  CHECK_PROBLEM(None)

int testInputProblems(Panel& panel, vtkMRMLModelNode* surface, vtkMRMLScalarVolumeNode* scale)
{
  Node* node = panel.node();
  vtkMRMLScene* scene = panel.host.scene();
  vtkMRMLNode* empty = scene->AddNewNodeByClass("vtkMRMLModelNode", "empty");
  vtkMRMLModelNode* ball = addClosedBall(scene, "ball", 5);
  node->SetNode(Node::SurfaceRole(), nullptr);
  CHECK_FIXED(NoSurface);
  node->SetNodes(Node::SurfaceRole(), { surface, empty });
  CHECK_PROBLEM(LabelledAmongOthers);
  node->SetNodes(Node::SurfaceRole(), { ball, surface });
  CHECK_FIXED(LabelledAmongOthers);
  node->SetNodes(Node::SurfaceRole(), { empty, surface });
  CHECK_FIXED(NotASurface);
  node->SetNode(Node::SurfaceRole(), ball);
  CHECK_FIXED(NoTargetLengths);
  node->SetEdgeLength(0); // as a script may; the panel's slider, which stays above, does not write to the node
  CHECK_FIXED(NoEdgeLength);
  CHECK_BOOL(node->GetEdgeLength() > 0, true);
  node->SetEdgeLengthSource(Node::FromScale);
  CHECK_FIXED(NoScale);
  node->SetEdgeLengthSource(Node::FromScale);
  node->SetNode(Node::ScaleRole(), scale);
  CHECK_PROBLEM(None);
  node->SetEdgeLengthSource(Node::FromSurface);
  node->SetNode(Node::SurfaceRole(), surface);
  node->SetNode(Node::MeshRole(), surface);
  CHECK_FIXED(OutputIsInput);
  return EXIT_SUCCESS;
}

int testParameterProblems(Panel& panel, const std::string& folder)
{
  Node* node = panel.node();
  vtkMRMLScene* scene = panel.host.scene();
  node->SetNonlinearDistance(5);
  CHECK_FIXED(NoPlaces);
  node->SetNullDisplacementRadius(5);
  CHECK_FIXED(NoTargets);
  node->SetNullDisplacementPathDistance(5);
  CHECK_FIXED(NoPaths);
  node->SetNullDisplacementPathDistanceAtTarget(5);
  CHECK_PROBLEM(NoEntryDistance);
  node->SetNullDisplacementPathDistanceAtTarget(0);
  node->SetNonlinearDistanceAtTarget(5);
  CHECK_PROBLEM(NoNonlinearEntry);
  node->SetNonlinearDistanceAtTarget(0);
  node->SetNode(Node::TargetRole(), addMarkups(scene, "vtkMRMLMarkupsFiducialNode", { { 0, 0, 0 } }));
  CHECK_FIXED(NoDistance);
  node->SetNode(Node::PathRole(), addMarkups(scene, "vtkMRMLMarkupsLineNode", { { 0, 0, 0 } }));
  CHECK_FIXED(NotAPath);
  node->SetNode(Node::TargetRole(), nullptr);
  node->SetNonlinearDistance(0);
  node->SetShellTissues("no such tissue");
  CHECK_FIXED(UnknownShell);
  node->SetNode(Node::ShellsRole(), scene->AddNewNodeByClass("vtkMRMLModelNode", "shells"));
  CHECK_FIXED(ShellsUnused);
  std::ofstream(folder + "/materials.csv") << "tissue,youngsModulus,poissonsRatio\nno such tissue,3,0.4\n";
  node->SetMaterialsFile(folder + "/materials.csv");
  CHECK_FIXED(BadMaterials);
  return EXIT_SUCCESS;
}

/// Edited since: its ambient tetrahedra are another mesh's now.
int testEditedSurface(Panel& panel, vtkMRMLModelNode* surface)
{
  CHECK_PROBLEM(None);
  double at[3];
  surface->GetPolyData()->GetPoints()->GetPoint(7, at);
  surface->GetPolyData()->GetPoints()->SetPoint(7, at[0] + 0.01, at[1], at[2]);
  surface->GetPolyData()->GetPoints()->Modified();
  surface->GetPolyData()->Modified();
  CHECK_PROBLEM(AmbientChanged);
  surface->GetPolyData()->GetPoints()->SetPoint(7, at);
  surface->GetPolyData()->GetPoints()->Modified();
  surface->GetPolyData()->Modified();
  CHECK_PROBLEM(None);
  return EXIT_SUCCESS;
}

int testCancel(Panel& panel)
{
  for (const double seconds : { 0.0, 0.05, 0.3 })
  {
    panel.node()->SetNode(Node::MeshRole(), nullptr);
    const LeftoverCheck check(panel.host.scene());
    panel.button("ApplyButton")->click();
    CHECK_BOOL(panel.run()->IsBusy(), true);
    CHECK_BOOL(panel.button("ApplyButton")->isEnabled(), false);
    CHECK_BOOL(panel.logic->Start(panel.node()), false); // a second one
    panel.host.waitFor(seconds);
    panel.button("CancelButton")->click();
    CHECK_BOOL(panel.waitForEnd(), true);
    if (panel.run()->GetStatus() == vtkSurgicalMesherRun::Completed) continue; // it was faster
    CHECK_INT(panel.run()->GetStatus(), vtkSurgicalMesherRun::Cancelled);
    CHECK_STD_STRING(check.leftovers(), "");
    CHECK_NULL(panel.node()->GetModelNode(Node::MeshRole()));
    CHECK_BOOL(panel.button("ApplyButton")->isEnabled(), true);
    panel.run()->SetCommandLineLogic(nullptr); // lets go of the run's folder
    CHECK_STD_STRING(filesOfRuns(), "");
  }
  return EXIT_SUCCESS;
}

/// The run has copies of its inputs, so it goes on.
int testInputDeletedWhileRunning(Panel& panel, const MeshedBalls& balls)
{
  vtkMRMLModelNode* doomed = loadModel(panel.host.scene(), balls.surface, "doomed");
  panel.node()->SetNode(Node::SurfaceRole(), doomed);
  CHECK_PROBLEM(None);
  panel.button("ApplyButton")->click();
  panel.host.scene()->RemoveNode(doomed);
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run()->GetStatus(), vtkSurgicalMesherRun::Completed);
  CHECK_BOOL(Logic::IsMesh(panel.node()->GetModelNode(Node::MeshRole())), true);
  CHECK_PROBLEM(NoSurface);
  return EXIT_SUCCESS;
}

/// The tetrahedra go to a new model then; those of a chosen one stay as they were until a run completes.
int testOutputDeletedWhileRunning(Panel& panel, vtkMRMLModelNode* surface)
{
  vtkMRMLModelNode* mesh = panel.node()->GetModelNode(Node::MeshRole());
  vtkPointSet* before = mesh->GetMesh();
  panel.node()->SetNode(Node::SurfaceRole(), surface);
  panel.button("ApplyButton")->click();
  panel.host.waitFor(0.05);
  panel.run()->Cancel();
  CHECK_BOOL(panel.waitForEnd(), true);
  if (panel.run()->GetStatus() == vtkSurgicalMesherRun::Cancelled) CHECK_POINTER(mesh->GetMesh(), before);

  panel.button("ApplyButton")->click();
  panel.host.scene()->RemoveNode(mesh);
  CHECK_NULL(panel.node()->GetModelNode(Node::MeshRole())); // not another model that happens to be there
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run()->GetStatus(), vtkSurgicalMesherRun::Completed);
  CHECK_BOOL(Logic::IsMesh(panel.node()->GetModelNode(Node::MeshRole())), true);
  CHECK_PROBLEM(None);
  return EXIT_SUCCESS;
}

/// A module's refusal comes to the panel as a sentence, and what was there stays.
int testRefusal(Panel& panel)
{
  vtkMRMLScene* scene = panel.host.scene();
  vtkMRMLModelNode* open = addClosedBall(scene, "open", 5);
  open->GetPolyData()->BuildLinks();
  open->GetPolyData()->DeleteCell(3);
  open->GetPolyData()->RemoveDeletedCells();
  panel.node()->SetNode(Node::SurfaceRole(), open);
  panel.node()->SetEdgeLengthSource(Node::Uniform);
  panel.node()->SetNode(Node::MeshRole(), nullptr);
  CHECK_PROBLEM(None);
  const LeftoverCheck check(scene);
  panel.button("ApplyButton")->click();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run()->GetStatus(), vtkSurgicalMesherRun::Failed);
  const std::string text = panel.run()->GetErrorText();
  CHECK_INT(text.find("open: the surface is open"), 0); // the model's name, not a file's
  CHECK_BOOL(text.find(panel.host.application().temporaryPath().toStdString()) == std::string::npos, true);
  auto* fault = vtkMRMLModelNode::SafeDownCast(scene->GetFirstNodeByName("Triangles at fault"));
  CHECK_NOT_NULL(fault);
  CHECK_INT(fault->GetPolyData()->GetNumberOfCells(), 3);
  CHECK_STD_STRING(check.leftovers({ "vtkMRMLModelNode", "vtkMRMLModelDisplayNode" }), "");
  panel.run()->SetCommandLineLogic(nullptr);
  CHECK_STD_STRING(filesOfRuns(), "");
  panel.host.complaints(); // the host logs that the module failed
  return EXIT_SUCCESS;
}

int testSceneClosedWhileRunning(Panel& panel, const MeshedBalls& balls)
{
  panel.node()->SetNode(Node::SurfaceRole(), loadSurface(panel.host.scene(), balls));
  panel.node()->SetEdgeLengthSource(Node::FromSurface);
  CHECK_PROBLEM(None);
  panel.button("ApplyButton")->click();
  panel.host.waitFor(0.05);
  panel.host.scene()->Clear(0);
  CHECK_BOOL(panel.run()->IsBusy(), false);
  CHECK_PROBLEM(NoSurface);
  CHECK_INT(panel.host.scene()->GetNumberOfNodesByClass("vtkMRMLModelNode"), 3); // the slices' own
  return EXIT_SUCCESS;
}

int testStates()
{
  HostApplication host;
  const MeshedBalls balls = meshBalls(host.scene(), "qSlicerFuchsTetrahedralizerModuleStatesTest");
  vtkMRMLModelNode* surface = loadSurface(host.scene(), balls);
  vtkMRMLScalarVolumeNode* scale = loadVolume(host.scene(), balls.scale, "scale");
  Panel panel{ host };
  CHECK_EXIT_SUCCESS(testInputProblems(panel, surface, scale));
  CHECK_EXIT_SUCCESS(testParameterProblems(panel, balls.folder));
  CHECK_EXIT_SUCCESS(testEditedSurface(panel, surface));
  CHECK_EXIT_SUCCESS(testCancel(panel));
  CHECK_EXIT_SUCCESS(testInputDeletedWhileRunning(panel, balls));
  CHECK_EXIT_SUCCESS(testOutputDeletedWhileRunning(panel, surface));
  CHECK_STD_STRING(host.complaints(), "");
  CHECK_EXIT_SUCCESS(testRefusal(panel));
  CHECK_EXIT_SUCCESS(testSceneClosedWhileRunning(panel, balls));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerFuchsTetrahedralizerModuleStatesTest(int, char*[])
{
  try
  {
    return testStates();
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
