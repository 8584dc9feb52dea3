// SPDX-License-Identifier: Apache-2.0
// The panel in the host: filled by its controls, run by its buttons, and put into every wrong state.

#include "ElementQuality.h"
#include "HostApplication.h"
#include "HostScene.h"
#include "MarkupsInput.h"
#include "MeshComparison.h"
#include "ModelMeshes.h"
#include "Slab.h"
#include "qSurgicalMesherRunWidget.h"
#include "vtkMRMLTemplateHexMesherNode.h"
#include "vtkSlicerTemplateHexMesherLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <qMRMLNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerMarkupsPlaceWidget.h>

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLayoutNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTableNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>

#include <cmath>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLTemplateHexMesherNode;
using Run = vtkSurgicalMesherRun;

namespace
{

struct Panel
{
  HostApplication& host;
  qSlicerAbstractModuleWidget* widget = host.enterPanel("TemplateHexMesher");
  vtkSlicerTemplateHexMesherLogic* logic =
    vtkSlicerTemplateHexMesherLogic::SafeDownCast(host.logic("TemplateHexMesher"));
  Run* run = logic->GetRun();

  Node* node() const { return logic->ParameterNode(); }
  template <class Child>
  Child* child(const char* name) const
  {
    return findChild<Child>(widget, name);
  }
  qSurgicalMesherRunWidget* foot() const { return child<qSurgicalMesherRunWidget>("RunWidget"); }
  QPushButton* button(const char* name) const { return findChild<QPushButton>(widget, name); }
  void choose(const char* selector, vtkMRMLNode* chosen) const
  {
    child<qMRMLNodeComboBox>(selector)->setCurrentNode(chosen);
  }
  std::string problem() const { return foot()->problem().toStdString(); }
  std::string sentence() const { return findChild<QLabel>(foot(), "RunSentence")->text().toStdString(); }
  void apply() const { button("ApplyButton")->click(); }
  bool waitForEnd() const
  {
    return host.waitUntil([this] { return !run->IsBusy(); });
  }
  void clear() const
  {
    host.scene()->Clear(0);
    host.waitFor(0.2);
  }
};

vtkSmartPointer<vtkPoints> inRAS(const Points& points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < points.cols(); ++i) result->InsertNextPoint(-points(0, i), -points(1, i), points(2, i));
  return result;
}

vtkMRMLModelNode* addModel(vtkMRMLScene* scene, const char* name, vtkPointSet* mesh)
{
  vtkNew<vtkMRMLModelNode> model;
  model->SetName(name);
  model->SetAndObserveMesh(mesh);
  scene->AddNode(model);
  model->CreateDefaultDisplayNodes();
  return model;
}

vtkMRMLModelNode* addHexahedra(vtkMRMLScene* scene, const char* name, const ElementMesh& mesh)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(inRAS(mesh.points));
  for (const Element& element : mesh.elements)
  {
    vtkIdType ids[8];
    std::copy(element.nodes.begin(), element.nodes.end(), ids);
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  }
  return addModel(scene, name, grid);
}

vtkMRMLModelNode* addSurface(vtkMRMLScene* scene, const char* name, const TriangleSurface& surface)
{
  vtkNew<vtkPolyData> data;
  data->SetPoints(inRAS(surface.points));
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : surface.triangles) cells->InsertNextCell({ a, b, c });
  data->SetPolys(cells);
  return addModel(scene, name, data);
}

/// A slab, a surface within it, and the slab bent; and fourteen landmarks.
struct Inputs
{
  ElementMesh mesh;
  vtkMRMLModelNode *source = nullptr, *target = nullptr, *carried = nullptr;
  vtkMRMLMarkupsNode *onTemplate = nullptr, *onTarget = nullptr;
};

void place(vtkMRMLMarkupsNode* list, const Eigen::Vector3d& at) { list->AddControlPoint(-at.x(), -at.y(), at.z()); }

Inputs fill(const Panel& panel, const ElementMesh& mesh)
{
  vtkMRMLScene* scene = panel.host.scene();
  Inputs inputs;
  inputs.mesh = mesh;
  const Points moved = bent(mesh.points);
  inputs.source = addHexahedra(scene, "Slab", mesh);
  inputs.target = addSurface(scene, "Patient", outerSurface({ moved, mesh.elements }));
  const ElementMesh thin = slab(4, 4, 1);
  inputs.carried = addSurface(scene, "Muscle", outerSurface({ 0.5 * thin.points, thin.elements }));
  inputs.onTemplate = addMarkups(scene, "vtkMRMLMarkupsFiducialNode", {});
  inputs.onTarget = addMarkups(scene, "vtkMRMLMarkupsFiducialNode", {});
  panel.choose("TemplateSelector", inputs.source);
  panel.choose("TargetSelector", inputs.target);
  panel.choose("TemplateLandmarksSelector", inputs.onTemplate);
  panel.choose("TargetLandmarksSelector", inputs.onTarget);
  for (Eigen::Index n = 0; n < 14; ++n)
  {
    const Eigen::Index node = 7919 * n % mesh.points.cols(); // all over the slab
    place(inputs.onTemplate, mesh.points.col(node));         // as a click in a view does: the panel names it
    place(inputs.onTarget, moved.col(node));
  }
  return inputs;
}

//--- The straight road ------------------------------------------------------

/// What the command line makes of the same, from files.
std::string runFromFiles(const std::string& name, const Inputs& inputs)
{
  const std::string folder = newFolder(name);
  writeModel(inputs.source, folder + "/template.vtu");
  writeModel(inputs.target, folder + "/target.vtp");
  writeLabelledMarkups({ labelledPoints(inputs.onTemplate) }, folder + "/a.mrk.json");
  writeLabelledMarkups({ labelledPoints(inputs.onTarget) }, folder + "/b.mrk.json");
  runCommandLine("TemplateFitCLI", { "--landmarks", folder + "/a.mrk.json", "--landmarks", folder + "/b.mrk.json",
                                     folder + "/template.vtu", folder + "/target.vtp", folder + "/fitted.vtu" });
  return folder + "/fitted.vtu";
}

double largestDifference(const std::string& file, vtkMRMLModelNode* model)
{
  const Points expected = readElementMesh(file).mesh.points, found = meshInWorld(model).mesh.points;
  if (expected.cols() != found.cols()) return 1e9;
  return (expected - found).cwiseAbs().maxCoeff();
}

int checkApply(const Panel& panel)
{
  const Inputs inputs = fill(panel, slab());
  panel.node()->SetNode(Node::CarriedRole(), inputs.carried);
  panel.host.waitFor(0.2); // the preview is there
  CHECK_NOT_NULL(panel.logic->GetPreview());
  const LeftoverCheck nodes(panel.host.scene());
  const std::set<std::string> files = temporaryFiles();
  CHECK_STD_STRING(panel.problem(), "");
  CHECK_BOOL(panel.button("ShowTableButton")->isEnabled(), false);
  panel.apply();
  CHECK_BOOL(panel.run->IsBusy(), true);
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  CHECK_INT(panel.run->GetStatus(), Run::Completed);

  vtkMRMLModelNode* fitted = panel.node()->GetModelNode(Node::FittedRole());
  CHECK_NOT_NULL(fitted);
  CHECK_BOOL(largestDifference(runFromFiles("TemplateHexMesherApply", inputs), fitted) < 1e-9, true);
  CHECK_INT(int(fitted->GetUnstructuredGrid()->GetNumberOfCells()), int(inputs.mesh.elements.size()));
  CHECK_STRING(fitted->GetDisplayNode()->GetActiveScalarName(), kQualityArray);
  CHECK_BOOL(fitted->GetDisplayNode()->GetScalarVisibility(), true);
  CHECK_BOOL(panel.node()->GetShowPreview(), false);
  auto* carried = panel.node()->GetModelNode(Node::CarriedResultRole());
  CHECK_NOT_NULL(carried);
  CHECK_BOOL(hasCells(carried), true);
  CHECK_BOOL(panel.sentence().find("160 elements, 0 invalid") != std::string::npos, true);
  vtkMRMLTableNode* table = panel.node()->GetTableNode(Node::QualityTableRole());
  CHECK_NOT_NULL(table);
  CHECK_INT(table->GetNumberOfRows(), 3);
  CHECK_STD_STRING(table->GetCellText(2, table->GetColumnIndex("invalid")), "0");
  CHECK_BOOL(std::stod(table->GetCellText(2, table->GetColumnIndex("to target (mm)"))) < 0.5, true);
  auto* rows = panel.child<QTableWidget>("LandmarkTable");
  CHECK_BOOL(rows->item(0, 3)->text().toDouble() < 0.5, true);
  CHECK_BOOL(rows->item(0, 3)->text().isEmpty(), false);
  CHECK_STD_STRING(nodes.leftovers({ "vtkMRMLModelNode", "vtkMRMLModelDisplayNode", "vtkMRMLTableNode" }), "");

  // Once more: the same nodes are filled, whatever transform they are under, and colours follow the panel.
  panel.host.waitFor(0.2);
  CHECK_BOOL(panel.logic->GetPreview()->GetDisplayNode()->GetVisibility(), false);
  const LeftoverCheck second(panel.host.scene());
  panel.child<QCheckBox>("ColorByQualityCheckBox")->setChecked(false);
  panel.child<QSpinBox>("IterationsSpinBox")->setValue(5);
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  CHECK_STD_STRING(second.leftovers(), "");
  CHECK_POINTER(panel.node()->GetModelNode(Node::FittedRole()), fitted);
  CHECK_BOOL(fitted->GetDisplayNode()->GetScalarVisibility(), false);
  panel.clear();
  CHECK_BOOL(temporaryFiles() == files, true);
  return EXIT_SUCCESS;
}

/// Everything of the template under one transform: as the landmarks take it to the patient, nothing changes.
int checkTransform(const Panel& panel)
{
  const Inputs inputs = fill(panel, slab());
  const std::string expected = runFromFiles("TemplateHexMesherTransform", inputs);
  vtkMRMLTransformNode* transform = addTransform(panel.host.scene());
  for (vtkMRMLTransformableNode* node : { static_cast<vtkMRMLTransformableNode*>(inputs.source),
                                          static_cast<vtkMRMLTransformableNode*>(inputs.onTemplate) })
    node->SetAndObserveTransformNodeID(transform->GetID());
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  CHECK_BOOL(largestDifference(expected, panel.node()->GetModelNode(Node::FittedRole())) < 0.05, true);
  panel.clear();
  return EXIT_SUCCESS;
}

/// A result belongs to the parameter node that its run was started for, also while another run is going on.
int checkTwoParameterNodes(const Panel& panel)
{
  fill(panel, slab());
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  CHECK_INT(int(panel.logic->GetFound(panel.node()).elements), 160);
  auto* other = Node::SafeDownCast(panel.host.scene()->AddNewNodeByClass("vtkMRMLTemplateHexMesherNode"));
  for (const char* role :
       { Node::TemplateRole(), Node::TargetRole(), Node::TemplateLandmarksRole(), Node::TargetLandmarksRole() })
    other->SetNode(role, panel.node()->GetNodeReference(role));
  CHECK_INT(panel.logic->Start(other).problem, FitCheck::None);
  CHECK_BOOL(panel.run->IsBusy(), true);
  CHECK_INT(int(panel.logic->GetFound(other).elements), 0);
  CHECK_INT(int(panel.logic->GetFound(panel.node()).elements), 160);
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(int(panel.logic->GetFound(other).elements), 160);
  CHECK_INT(int(panel.logic->GetFound(panel.node()).elements), 0);
  panel.clear();
  return EXIT_SUCCESS;
}

//--- Landmarks --------------------------------------------------------------

/// The preview takes each landmark of the template to its partner, and follows it.
int checkPreview(const Panel& panel)
{
  const Inputs inputs = fill(panel, slab());
  panel.host.waitFor(0.2);
  vtkMRMLModelNode* preview = panel.logic->GetPreview();
  CHECK_NOT_NULL(preview);
  CHECK_BOOL(preview->GetDisplayNode()->GetVisibility(), true);
  const Eigen::Vector3d corner = bent(inputs.mesh.points).col(0);
  const auto distance = [&](const Eigen::Vector3d& to)
  {
    double p[3];
    preview->GetMesh()->GetPoint(0, p); // the first node lies on the surface
    return (Eigen::Vector3d(-p[0], -p[1], p[2]) - to).norm();
  };
  CHECK_BOOL(distance(corner) < 1e-3, true);
  inputs.onTarget->SetNthControlPointPosition(0, -corner.x() + 5, -corner.y(), corner.z());
  panel.host.waitFor(0.2);
  CHECK_BOOL(distance(corner - Eigen::Vector3d(5, 0, 0)) < 1e-3, true);
  auto* table = panel.child<QTableWidget>("LandmarkTable");
  const double mistaken = table->item(0, 2)->text().toDouble();
  for (int row = 1; row < table->rowCount(); ++row) CHECK_BOOL(table->item(row, 2)->text().toDouble() < mistaken, true);

  panel.child<QCheckBox>("ShowPreviewCheckBox")->setChecked(false);
  panel.host.waitFor(0.2);
  CHECK_BOOL(preview->GetDisplayNode()->GetVisibility(), false);
  panel.child<QCheckBox>("ShowPreviewCheckBox")->setChecked(true);
  while (inputs.onTarget->GetNumberOfControlPoints() > 3) inputs.onTarget->RemoveNthControlPoint(3);
  panel.host.waitFor(0.2);
  CHECK_BOOL(preview->GetDisplayNode()->GetVisibility(), false); // too few
  panel.clear();
  return EXIT_SUCCESS;
}

int checkPlacing(const Panel& panel)
{
  panel.choose("TemplateSelector", addHexahedra(panel.host.scene(), "Slab", slab()));
  panel.choose("TargetSelector", addHexahedra(panel.host.scene(), "Patient", slab()));
  CHECK_BOOL(panel.problem().empty(), false);
  panel.button("FixButton")->click(); // place pairs
  vtkMRMLMarkupsNode* onTemplate = panel.node()->GetMarkupsNode(Node::TemplateLandmarksRole());
  vtkMRMLMarkupsNode* onTarget = panel.node()->GetMarkupsNode(Node::TargetLandmarksRole());
  CHECK_NOT_NULL(onTemplate);
  CHECK_NOT_NULL(onTarget);
  auto* first = panel.child<qSlicerMarkupsPlaceWidget>("TemplatePlaceWidget");
  auto* second = panel.child<qSlicerMarkupsPlaceWidget>("TargetPlaceWidget");
  CHECK_BOOL(first->placeModeEnabled(), true);
  CHECK_BOOL(second->placeModeEnabled(), false);
  const auto placed = [&](vtkMRMLMarkupsNode* list, double x)
  {
    list->AddControlPoint(x, 2 * x * x, 3);
    panel.host.waitFor(0.1);
    return std::string(list->GetNthControlPointLabel(list->GetNumberOfControlPoints() - 1));
  };
  CHECK_STD_STRING(placed(onTemplate, 1), "L1");
  CHECK_BOOL(second->placeModeEnabled(), true); // it is the patient's turn
  CHECK_BOOL(first->placeModeEnabled(), false);
  CHECK_STD_STRING(placed(onTarget, 1), "L1");
  CHECK_BOOL(first->placeModeEnabled(), true);
  CHECK_STD_STRING(placed(onTemplate, 2), "L2");
  CHECK_STD_STRING(placed(onTarget, 2), "L2");

  // A pair that is removed leaves its name to the next one.
  auto* table = panel.child<QTableWidget>("LandmarkTable");
  CHECK_INT(table->rowCount(), 2);
  CHECK_STD_STRING(table->item(1, 1)->text().toStdString(), "both");
  CHECK_BOOL(panel.button("RemoveLandmarkButton")->isEnabled(), false);
  table->selectRow(0);
  panel.button("RemoveLandmarkButton")->click();
  CHECK_INT(table->rowCount(), 1);
  CHECK_STD_STRING(table->item(0, 0)->text().toStdString(), "L2");
  CHECK_STD_STRING(placed(onTemplate, 3), "L1");
  CHECK_STD_STRING(table->item(1, 1)->text().toStdString(), "template");

  second->setPlaceModeEnabled(false); // as by the Escape key
  panel.host.waitFor(0.1);
  CHECK_BOOL(panel.button("PlacePairsButton")->isChecked(), false);
  panel.button("PlacePairsButton")->click();
  CHECK_BOOL(second->placeModeEnabled(), true);
  panel.host.leavePanel();
  CHECK_BOOL(first->placeModeEnabled() || second->placeModeEnabled(), false);
  panel.host.enterPanel("TemplateHexMesher");
  panel.clear();
  return EXIT_SUCCESS;
}

int checkSideBySide(const Panel& panel)
{
  const Inputs inputs = fill(panel, slab());
  auto* layout = vtkMRMLLayoutNode::SafeDownCast(panel.host.scene()->GetFirstNodeByClass("vtkMRMLLayoutNode"));
  const int former = layout->GetViewArrangement();
  panel.child<QCheckBox>("SideBySideCheckBox")->setChecked(true);
  panel.host.waitFor(0.2);
  CHECK_INT(layout->GetViewArrangement(), vtkMRMLLayoutNode::SlicerLayoutDual3DView);
  const auto views = [](vtkMRMLDisplayableNode* node) { return node->GetDisplayNode()->GetViewNodeIDs(); };
  CHECK_INT(int(views(inputs.source).size()), 1);
  CHECK_BOOL(views(inputs.source) == views(inputs.onTemplate), true);
  CHECK_BOOL(views(inputs.target) == views(inputs.onTarget), true);
  CHECK_BOOL(views(inputs.target) == views(panel.logic->GetPreview()), true);
  CHECK_BOOL(views(inputs.source) == views(inputs.target), false);
  panel.child<QCheckBox>("SideBySideCheckBox")->setChecked(false);
  panel.host.waitFor(0.2);
  CHECK_INT(layout->GetViewArrangement(), former);
  CHECK_BOOL(views(inputs.source).empty() && views(inputs.onTarget).empty(), true);
  panel.clear();
  return EXIT_SUCCESS;
}

//--- Wrong states -----------------------------------------------------------

/// Each is told by a sentence of its own, and keeps Apply from being pressed.
int checkSentences(const Panel& panel)
{
  std::set<std::string> sentences;
  const auto isRefused = [&]
  { return !panel.button("ApplyButton")->isEnabled() && sentences.insert(panel.problem()).second; };
  CHECK_BOOL(isRefused(), true); // nothing there
  const Inputs inputs = fill(panel, slab());
  CHECK_STD_STRING(panel.problem(), "");
  panel.choose("TargetSelector", nullptr);
  CHECK_BOOL(isRefused(), true);
  panel.choose("TargetSelector", inputs.source);
  CHECK_BOOL(isRefused(), true); // both
  vtkMRMLModelNode* empty = addModel(panel.host.scene(), "Empty", vtkNew<vtkPolyData>());
  panel.choose("TargetSelector", empty);
  CHECK_BOOL(isRefused(), true);
  panel.choose("TargetSelector", inputs.target);
  panel.choose("TargetLandmarksSelector", nullptr);
  CHECK_BOOL(isRefused(), true);
  panel.choose("TargetLandmarksSelector", inputs.onTarget);
  inputs.onTarget->SetNthControlPointLabel(0, "nose");
  CHECK_BOOL(isRefused(), true); // no partner
  inputs.onTarget->SetNthControlPointLabel(0, inputs.onTemplate->GetNthControlPointLabel(0));
  CHECK_STD_STRING(panel.problem(), "");
  while (inputs.onTarget->GetNumberOfControlPoints() > 3)
  {
    inputs.onTarget->RemoveNthControlPoint(3);
    inputs.onTemplate->RemoveNthControlPoint(3);
  }
  CHECK_BOOL(isRefused(), true); // three pairs
  panel.clear();
  return EXIT_SUCCESS;
}

/// What only the module finds out.
int checkFailure(const Panel& panel)
{
  ElementMesh turned = slab();
  for (Element& element : turned.elements)
  {
    for (int i = 0; i < 4; ++i) std::swap(element.nodes[i], element.nodes[i + 4]);
  }
  fill(panel, turned);
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Failed);
  CHECK_BOOL(panel.sentence().find("inside out") != std::string::npos, true);
  panel.host.complaints(); // the host's own, on the module's status
  CHECK_NULL(panel.node()->GetModelNode(Node::FittedRole()));
  panel.clear();
  return EXIT_SUCCESS;
}

int checkCancel(const Panel& panel)
{
  fill(panel, slab(60, 48, 6)); // long enough to be cancelled
  panel.host.waitFor(0.3);
  const LeftoverCheck nodes(panel.host.scene());
  for (const double delay : { 0.0, 0.4, 0.8 })
  {
    panel.apply();
    panel.host.waitFor(delay);
    CHECK_BOOL(panel.run->IsBusy(), true);
    panel.button("CancelButton")->click();
    CHECK_BOOL(panel.waitForEnd(), true);
    CHECK_INT(panel.run->GetStatus(), Run::Cancelled);
    CHECK_STD_STRING(nodes.leftovers(), "");
    CHECK_NULL(panel.node()->GetModelNode(Node::FittedRole()));
    CHECK_STD_STRING(panel.sentence(), "Cancelled.");
  }
  panel.clear();
  return EXIT_SUCCESS;
}

int checkSceneClosed(const Panel& panel)
{
  const std::set<std::string> files = temporaryFiles();
  for (const double delay : { 0.0, 0.5 })
  {
    fill(panel, slab(60, 48, 6));
    panel.apply();
    panel.host.waitFor(delay);
    panel.host.scene()->Clear(0);
    CHECK_BOOL(panel.run->IsBusy(), false);
    panel.host.waitFor(0.5);
    CHECK_NULL(panel.host.scene()->GetFirstNodeByClass("vtkMRMLCommandLineModuleNode"));
    CHECK_BOOL(panel.problem().empty(), false);
    CHECK_INT(panel.child<QTableWidget>("LandmarkTable")->rowCount(), 0);
  }
  CHECK_BOOL(temporaryFiles() == files, true);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerTemplateHexMesherModuleWidgetTest(int, char*[])
{
  HostApplication host;
  const Panel panel{ host };
  for (const auto check : { checkSentences, checkPlacing, checkPreview, checkSideBySide, checkApply, checkTransform,
                            checkTwoParameterNodes, checkFailure, checkCancel, checkSceneClosed })
  {
    CHECK_EXIT_SUCCESS(check(panel));
    CHECK_STD_STRING(host.complaints(), "");
  }
  return EXIT_SUCCESS;
}
