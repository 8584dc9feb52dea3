// SPDX-License-Identifier: Apache-2.0
// The panel as a user meets it: it says what is missing, lists the tissues, and its runs leave the nodes that they
// should, with the very mesh that the command line writes.

#include "MeshComparison.h"
#include "MeshIO.h"
#include "Panel.h"

#include <ctkSliderWidget.h>
#include <qMRMLTableView.h>

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLModelStorageNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLPlotSeriesNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLTableNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkAbstractTransform.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QRadioButton>
#include <QSpinBox>

#include <algorithm>
#include <fstream>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLSimplexMesherNode;
using Table = qSlicerSimplexMesherTissueTable;

namespace
{

int testSentencesAndFixes(Panel& panel)
{
  CHECK_BOOL(panel.problem().find("no segmentation or label map") != std::string::npos, true);
  CHECK_BOOL(panel.child<QPushButton>("ApplyButton")->isEnabled(), false);
  vtkMRMLLabelMapVolumeNode* balls = addNestedBalls(panel.host.scene());
  panel.widget->enter();
  CHECK_BOOL(panel.problem().find("Choose") != std::string::npos, true);
  panel.press("FixButton");
  CHECK_POINTER(panel.node()->GetNodeReference(Node::TissueMapRole()), balls);
  CHECK_BOOL(panel.problem().find("scale volume") != std::string::npos, true);
  panel.press("FixButton");
  CHECK_BOOL(panel.child<QRadioButton>("EdgeLengthRadioButton")->isChecked(), true);
  CHECK_STD_STRING(panel.problem(), "");
  CHECK_BOOL(panel.child<QPushButton>("ApplyButton")->isEnabled(), true);
  return EXIT_SUCCESS;
}

int testProximityAndSurroundings(Panel& panel)
{
  CHECK_DOUBLE(panel.child<ctkSliderWidget>("SmoothingSlider")->value(), 0.7);
  CHECK_DOUBLE(panel.child<ctkSliderWidget>("RigiditySlider")->value(), 0.28);
  CHECK_INT(panel.child<QComboBox>("ContinuityComboBox")->currentIndex(), 2);
  CHECK_INT(panel.child<QComboBox>("ContinuityComboBox")->count(), 3);
  auto* far = panel.child<QDoubleSpinBox>("ProximityFarSpinBox");
  far->setValue(1.5);
  CHECK_BOOL(panel.problem().find("proximity") != std::string::npos, true);
  panel.press("FixButton");
  CHECK_DOUBLE(panel.node()->GetProximityNear(), 1.5);
  CHECK_STD_STRING(panel.problem(), "");
  panel.child<QSpinBox>("BackgroundSpinBox")->setValue(1);
  CHECK_BOOL(panel.problem().find("tumour") != std::string::npos, true);
  panel.press("FixButton");
  CHECK_INT(panel.node()->GetBackground(), 0);
  CHECK_STD_STRING(panel.problem(), "");
  for (const char* box : { "ProximityNearSpinBox", "ProximityFarSpinBox" })
    panel.child<QDoubleSpinBox>(box)->setValue(0);
  return EXIT_SUCCESS;
}

/// Opens the editor of a cell, as a double click does, types into it, and presses Return.
template <class Editor, class Type>
void type(Panel& panel, int row, int column, const Type& typeInto)
{
  QTableView* view = panel.table()->view();
  view->setCurrentIndex(view->model()->index(row, column));
  view->edit(view->currentIndex());
  auto* editor = qobject_cast<Editor*>(view->indexWidget(view->currentIndex()));
  if (!editor) return;
  typeInto(editor);
  QKeyEvent enter(QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier);
  QApplication::sendEvent(editor, &enter);
  panel.host.waitFor(0.1); // the editor commits after the event
}

int testEditors(Panel& panel)
{
  type<QComboBox>(panel, 1, Table::RoleColumn, [](QComboBox* box) { box->setEditText("vessels"); });
  CHECK_STD_STRING(panel.node()->GetTissueSetting("2").group, "vessels");
  int choices = 0;
  type<QComboBox>(panel, 0, Table::RoleColumn,
                  [&](QComboBox* box)
                  {
                    choices = box->count();
                    box->setCurrentIndex(choices - 1);
                  });
  CHECK_INT(choices, 4); // three roles and the group
  CHECK_STD_STRING(panel.node()->GetTissueSetting("1").group, "vessels");
  panel.table()->view()->selectAll();
  type<QDoubleSpinBox>(panel, 1, Table::MinimumColumn, [](QDoubleSpinBox* spin) { spin->setValue(1.5); });
  CHECK_DOUBLE(panel.node()->GetTissueSetting("2").minimumEdgeLength, 1.5);
  panel.table()->view()->selectAll();
  panel.table()->resetSelected();
  panel.table()->view()->clearSelection();
  return EXIT_SUCCESS;
}

int testTissueTable(Panel& panel)
{
  CHECK_INT(panel.table()->view()->model()->rowCount(), 2);
  CHECK_STD_STRING(panel.cell(0, Table::NameColumn).toString().toStdString(), "tumour");
  CHECK_BOOL(panel.cell(0, Table::NameColumn, Qt::DecorationRole).value<QColor>().red() > 200, true);
  panel.edit(0, Table::RoleColumn, Table::tr("Shell"));
  panel.edit(0, Table::MinimumColumn, 2.5);
  CHECK_BOOL(panel.node()->GetTissueSetting("1").role == TissueRole::Shell, true);
  CHECK_DOUBLE(panel.node()->GetTissueSetting("1").minimumEdgeLength, 2.5);
  panel.edit(0, Table::MaximumColumn, 4);
  CHECK_BOOL(panel.problem().find("tumour") != std::string::npos, true);
  panel.press("FixButton"); // drops the maximum
  CHECK_STD_STRING(panel.problem(), "");

  panel.table()->view()->selectAll();
  panel.edit(1, Table::ProtectedColumn, Qt::Checked, Qt::CheckStateRole); // one of the selected rows: all of them
  CHECK_BOOL(panel.node()->GetTissueSetting("1").isProtected, true);
  CHECK_BOOL(panel.node()->GetTissueSetting("2").isProtected, true);
  panel.table()->leaveOutSelected();
  CHECK_BOOL(panel.problem().empty(), false);
  panel.press("FixButton");
  CHECK_BOOL(panel.node()->GetTissueSettings().empty(), true);
  panel.table()->view()->selectAll();
  panel.table()->groupSelected("head, \"all\"");
  CHECK_STD_STRING(panel.cell(1, Table::RoleColumn).toString().toStdString(), "head, \"all\"");
  panel.table()->resetSelected();
  CHECK_BOOL(panel.node()->GetTissueSettings().empty(), true);
  panel.table()->view()->clearSelection();
  return EXIT_SUCCESS;
}

/// Label map and settings go to the command line as files; the panel has the same settings.
int testSameMesh(Panel& panel)
{
  const std::string folder = newFolder("SimplexMesherWidgetTest");
  auto* balls = vtkMRMLLabelMapVolumeNode::SafeDownCast(panel.node()->GetNodeReference(Node::TissueMapRole()));
  const std::string map = savedByHost(balls, folder + "/map.nrrd");
  const std::string names = savedByHost(balls->GetDisplayNode()->GetColorNode(), folder + "/names.ctbl");
  std::ofstream(folder + "/tissues.csv") << "name,maximum,protected\ntumour,2,yes\n";

  panel.child<ctkSliderWidget>("EdgeLengthSlider")->setValue(3);
  panel.edit(0, Table::MaximumColumn, 2);
  panel.edit(0, Table::ProtectedColumn, Qt::Checked, Qt::CheckStateRole);
  panel.child<qMRMLNodeComboBox>("PreparedLabelMapSelector")->addNode();
  panel.child<qMRMLNodeComboBox>("SimplexMeshSelector")->addNode();
  CHECK_BOOL(panel.apply(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  CHECK_INT(panel.run->GetStatus(), vtkSurgicalMesherRun::Completed);

  runCommandLine("SimplexMesherCLI",
                 { "--edgeLength", "3", "--names", names, "--tissues", folder + "/tissues.csv", "--ambient",
                   folder + "/ambient.vtu", "--simplexMesh", folder + "/simplex.vtp", map, folder + "/surface.vtp" });
  vtkMRMLModelNode* surface = panel.node()->GetModelNode(Node::SurfaceRole());
  CHECK_STD_STRING(differenceOf(folder + "/surface.vtp", surface), "");
  CHECK_STD_STRING(differenceOf(folder + "/simplex.vtp", panel.node()->GetModelNode(Node::SimplexMeshRole())), "");
  auto* ambient = vtkMRMLModelNode::SafeDownCast(surface->GetNodeReference(Node::AmbientTetrahedraRole()));
  CHECK_STD_STRING(differenceOf(folder + "/ambient.vtu", ambient), "");
  writeSurface(readSurface(savedByHost(surface, folder + "/saved.vtp")), folder + "/again.vtp");
  CHECK_BOOL(sameBytes(folder + "/surface.vtp", folder + "/again.vtp"), true);
  return EXIT_SUCCESS;
}

/// Options of the surface's shape reach the command line, each with a value that isn't its default.
int testSameShape(Panel& panel)
{
  const std::string folder = newFolder("SimplexMesherShapeTest");
  auto* balls = vtkMRMLLabelMapVolumeNode::SafeDownCast(panel.node()->GetNodeReference(Node::TissueMapRole()));
  const std::string map = savedByHost(balls, folder + "/map.nrrd");
  const std::string names = savedByHost(balls->GetDisplayNode()->GetColorNode(), folder + "/names.ctbl");
  std::ofstream(folder + "/tissues.csv") << "name,maximum,protected\ntumour,2,yes\n"; // of the run before
  panel.child<ctkSliderWidget>("SmoothingSlider")->setValue(0.5);
  panel.child<ctkSliderWidget>("RigiditySlider")->setValue(0.4);
  panel.child<QComboBox>("ContinuityComboBox")->setCurrentIndex(1);
  panel.child<QDoubleSpinBox>("ProximityNearSpinBox")->setValue(0.5);
  panel.child<QDoubleSpinBox>("ProximityFarSpinBox")->setValue(1);
  panel.child<QDoubleSpinBox>("ChordErrorSpinBox")->setValue(0.1);
  panel.child<QSpinBox>("BackgroundSpinBox")->setValue(9);
  CHECK_BOOL(panel.apply(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  runCommandLine("SimplexMesherCLI", { "--edgeLength",
                                       "3",
                                       "--names",
                                       names,
                                       "--tissues",
                                       folder + "/tissues.csv",
                                       "--smoothing",
                                       "0.5",
                                       "--rigidity",
                                       "0.4",
                                       "--continuity",
                                       "1",
                                       "--proximity",
                                       "0.5,1",
                                       "--chordError",
                                       "0.1",
                                       "--background",
                                       "9",
                                       map,
                                       folder + "/surface.vtp" });
  CHECK_STD_STRING(differenceOf(folder + "/surface.vtp", panel.node()->GetModelNode(Node::SurfaceRole())), "");
  CHECK_INT(panel.node()->GetTableNode(Node::TissueTableRole())->GetNumberOfRows(), 3); // the surroundings are one
  return EXIT_SUCCESS;
}

/// As a panel has them that nobody has touched.
int testShapeAtDefaults(Panel& panel)
{
  const vtkNew<vtkMRMLSimplexMesherNode> fresh;
  panel.node()->SetSmoothing(fresh->GetSmoothing());
  panel.node()->SetRigidity(fresh->GetRigidity());
  panel.node()->SetContinuity(fresh->GetContinuity());
  panel.node()->SetProximityNear(0);
  panel.node()->SetProximityFar(0);
  panel.node()->SetChordError(0);
  panel.node()->SetBackground(0);
  CHECK_DOUBLE(panel.child<ctkSliderWidget>("SmoothingSlider")->value(), fresh->GetSmoothing());
  CHECK_BOOL(panel.apply(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  return EXIT_SUCCESS;
}

/// Of the rows from `first` to the one before `end`.
double sumOfCounts(vtkMRMLTableNode* shape, int first, int end)
{
  double sum = 0;
  for (int row = first; row < end; ++row) sum += shape->GetTable()->GetValue(row, 1).ToDouble();
  return sum;
}

int testShapeTables(Panel& panel)
{
  vtkMRMLTableNode* shape = panel.node()->GetTableNode(Node::ShapeTableRole());
  CHECK_INT(shape->GetNumberOfRows(), 10); // three kinds of roughness, five reasons for folds, ears and free ones
  CHECK_INT(shape->GetNumberOfColumns(), 5);
  CHECK_DOUBLE(sumOfCounts(shape, 0, 3), 0); // smoothing takes nothing from the balls
  const double folds = sumOfCounts(shape, 3, 8);
  vtkMRMLTableNode* longest = panel.node()->GetTableNode(Node::FoldTableRole());
  CHECK_DOUBLE(double(longest->GetNumberOfRows()), std::min(20., folds));
  CHECK_INT(longest->GetNumberOfColumns(), 7);
  vtkMRMLTableNode* ears = panel.node()->GetTableNode(Node::EarTableRole());
  CHECK_DOUBLE(double(ears->GetNumberOfRows()), std::min(20., shape->GetTable()->GetValue(8, 1).ToDouble()));
  auto* tables = panel.child<QComboBox>("ReportTableComboBox");
  CHECK_INT(tables->count(), 5);
  tables->setCurrentIndex(2);
  CHECK_POINTER(panel.child<qMRMLTableView>("ReportTableView")->mrmlTableNode(), shape);
  return EXIT_SUCCESS;
}

/// Operations on the interface are among those on any edge.
int testEvolutionTable(vtkTable* evolution)
{
  CHECK_INT(int(evolution->GetNumberOfColumns()), 15);
  constexpr int t1 = 7, t7 = 9, collapses = 12;
  for (vtkIdType step = 0; step < evolution->GetNumberOfRows(); ++step)
    for (int column = t1; column <= t7; ++column)
      CHECK_BOOL(
        evolution->GetValue(step, column).ToInt() <= evolution->GetValue(step, column + collapses - t1).ToInt(), true);
  return EXIT_SUCCESS;
}

int testNodesOfRun(Panel& panel)
{
  vtkMRMLModelNode* surface = panel.node()->GetModelNode(Node::SurfaceRole());
  CHECK_STRING(surface->GetName(), "NestedBalls surface");
  CHECK_BOOL(surface->GetDisplayVisibility() != 0, true);
  vtkMRMLModelDisplayNode* display = surface->GetModelDisplayNode();
  CHECK_STRING(display->GetActiveScalarName(), "BoundaryLabels");
  CHECK_BOOL(display->GetScalarVisibility(), true);
  CHECK_STRING(display->GetColorNode()->GetColorName(1), "tumour");
  auto* ambient = vtkMRMLModelNode::SafeDownCast(surface->GetNodeReference(Node::AmbientTetrahedraRole()));
  CHECK_NOT_NULL(ambient);
  CHECK_BOOL(ambient->GetHideFromEditors() != 0, true);
  CHECK_BOOL(ambient->GetDisplayVisibility() != 0, false);
  CHECK_NOT_NULL(panel.node()->GetLabelMapNode(Node::PreparedLabelMapRole())->GetImageData());

  vtkMRMLTableNode* tissues = panel.node()->GetTableNode(Node::TissueTableRole());
  CHECK_INT(tissues->GetNumberOfRows(), 2);
  CHECK_STD_STRING(tissues->GetCellText(0, 1), "tumour");
  const double area = tissues->GetTable()->GetValue(0, 2).ToDouble();
  CHECK_BOOL(area > 0.9 * 4 * 3.1416 * 36 && area < 1.1 * 4 * 3.1416 * 36, true); // a sphere of 6 mm
  CHECK_INT(tissues->GetTable()->GetValue(1, 6).ToInt(), 1);                      // the ball in the shell: a cavity
  vtkMRMLTableNode* evolution = panel.node()->GetTableNode(Node::EvolutionTableRole());
  CHECK_BOOL(evolution->GetNumberOfRows() > 3, true);
  CHECK_EXIT_SUCCESS(testEvolutionTable(evolution->GetTable()));
  CHECK_INT(panel.node()->GetNumberOfNodeReferences(Node::EvolutionChartRole()), 3);
  CHECK_POINTER(panel.node()->GetPlotChartNode(Node::EvolutionChartRole())->GetNthPlotSeriesNode(0)->GetTableNode(),
                evolution);
  CHECK_INT(panel.child<QComboBox>("PlotComboBox")->count(), 3);
  panel.press("ShowPlotButton");
  return EXIT_SUCCESS;
}

/// A second run fills the same nodes; only the tissues' models are new.
int testTissueModels(Panel& panel)
{
  const LeftoverCheck before(panel.host.scene());
  vtkMRMLModelNode* surface = panel.node()->GetModelNode(Node::SurfaceRole());
  panel.child<QCheckBox>("TissueModelsCheckBox")->setChecked(true);
  CHECK_BOOL(panel.apply(), true);
  CHECK_POINTER(panel.node()->GetModelNode(Node::SurfaceRole()), surface);
  CHECK_STD_STRING(before.leftovers({ "vtkMRMLModelNode", "vtkMRMLModelDisplayNode" }), "");
  CHECK_INT(surface->GetNumberOfNodeReferences("tissueModels"), 2);
  auto* tumour = vtkMRMLModelNode::SafeDownCast(surface->GetNthNodeReference("tissueModels", 0));
  CHECK_STRING(tumour->GetName(), "tumour");
  CHECK_BOOL(tumour->GetDisplayNode()->GetColor()[0] > 0.85, true);
  CHECK_INT(surface->GetDisplayVisibility(), 0);
  vtkIdType triangles = 0;
  for (int i = 0; i < 2; ++i)
    triangles += vtkMRMLModelNode::SafeDownCast(surface->GetNthNodeReference("tissueModels", i))
                   ->GetPolyData()
                   ->GetNumberOfCells();
  CHECK_BOOL(triangles == surface->GetPolyData()->GetNumberOfCells() + tumour->GetPolyData()->GetNumberOfCells(), true);

  panel.child<QCheckBox>("TissueModelsCheckBox")->setChecked(false);
  panel.child<QCheckBox>("KeepAmbientCheckBox")->setChecked(false);
  CHECK_BOOL(panel.apply(), true);
  CHECK_INT(surface->GetNumberOfNodeReferences("tissueModels"), 0);
  CHECK_NULL(surface->GetNodeReference(Node::AmbientTetrahedraRole()));
  CHECK_STD_STRING(before.leftovers(), "");
  return EXIT_SUCCESS;
}

/// The same tissues as segments, moved by a transform: the same mesh, moved.
int testSegmentation(Panel& panel)
{
  vtkMRMLScene* scene = panel.host.scene();
  auto* balls = vtkMRMLLabelMapVolumeNode::SafeDownCast(panel.node()->GetNodeReference(Node::TissueMapRole()));
  vtkNew<vtkPolyData> reference;
  reference->DeepCopy(panel.node()->GetModelNode(Node::SurfaceRole())->GetPolyData());
  vtkMRMLSegmentationNode* segments = addSegmentation(scene, balls);
  vtkMRMLTransformNode* transform = addTransform(scene);
  segments->SetAndObserveTransformNodeID(transform->GetID());
  panel.choose("TissueMapSelector", segments);
  CHECK_INT(panel.table()->view()->model()->rowCount(), 2);
  panel.edit(0, Table::MaximumColumn, 2);
  panel.edit(0, Table::ProtectedColumn, Qt::Checked, Qt::CheckStateRole);
  CHECK_BOOL(panel.node()->GetTissueSettings().count("1") == 1 && panel.node()->GetTissueSettings().size() == 2, true);
  CHECK_BOOL(panel.apply(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  vtkPolyData* moved = panel.node()->GetModelNode(Node::SurfaceRole())->GetPolyData();
  CHECK_BOOL(moved->GetNumberOfPoints() == reference->GetNumberOfPoints(), true);
  CHECK_BOOL(moved->GetNumberOfCells() == reference->GetNumberOfCells(), true);
  for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i)
  {
    double expected[3], error = 0;
    transform->GetTransformToParent()->TransformPoint(reference->GetPoint(i), expected);
    for (int axis = 0; axis < 3; ++axis) error += std::abs(expected[axis] - moved->GetPoint(i)[axis]);
    CHECK_DOUBLE_TOLERANCE(error, 0, 1e-3);
  }
  return EXIT_SUCCESS;
}

/// A ball with two voxels that stick out, which smoothing takes away as an ear.
int testRoughness(Panel& panel)
{
  const auto labelAt = [](const Point& p)
  {
    const bool isEar = p[0] > 10 && p[0] < 12 && p[1] > 0 && p[1] < 1 && p[2] > 0 && p[2] < 1;
    return isEar || p[0] * p[0] + p[1] * p[1] + p[2] * p[2] < 100 ? 2 : 0;
  };
  panel.choose("TissueMapSelector", addLabelMap(panel.host.scene(), "Rough", 26, 1, labelAt));
  CHECK_BOOL(panel.apply(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  vtkMRMLTableNode* shape = panel.node()->GetTableNode(Node::ShapeTableRole());
  CHECK_DOUBLE(sumOfCounts(shape, 1, 2), 1);
  CHECK_INT(shape->GetTable()->GetValue(1, 2).ToInt(), 2); // voxels
  return EXIT_SUCCESS;
}

int testSceneRestoresPanel(Panel& panel)
{
  const std::string file = newFolder("SimplexMesherSceneTest") + "/scene.mrml";
  panel.child<ctkSliderWidget>("EdgeLengthSlider")->setValue(4.5);
  std::vector<vtkMRMLNode*> volumes; // their voxels are not saved here, and the host may crash on drawing none
  panel.host.scene()->GetNodesByClass("vtkMRMLVolumeNode", volumes);
  for (vtkMRMLNode* volume : volumes) panel.host.scene()->RemoveNode(volume);
  panel.host.scene()->SetURL(file.c_str());
  panel.host.scene()->Commit(file.c_str());
  panel.host.scene()->Clear(0);
  CHECK_DOUBLE(panel.child<ctkSliderWidget>("EdgeLengthSlider")->value(), 2);
  CHECK_INT(panel.table()->view()->model()->rowCount(), 0);
  CHECK_BOOL(panel.problem().empty(), false);
  panel.host.scene()->SetURL(file.c_str());
  panel.host.scene()->Connect();
  CHECK_DOUBLE(panel.child<ctkSliderWidget>("EdgeLengthSlider")->value(), 4.5);
  CHECK_BOOL(panel.child<QRadioButton>("EdgeLengthRadioButton")->isChecked(), true);
  CHECK_INT(panel.host.scene()->GetNumberOfNodesByClass("vtkMRMLSimplexMesherNode"), 1);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerSimplexMesherModuleWidgetTest(int, char*[])
{
  HostApplication host;
  Panel panel{ host };
  CHECK_EXIT_SUCCESS(testSentencesAndFixes(panel));
  CHECK_EXIT_SUCCESS(testTissueTable(panel));
  CHECK_EXIT_SUCCESS(testEditors(panel));
  CHECK_EXIT_SUCCESS(testProximityAndSurroundings(panel));
  CHECK_EXIT_SUCCESS(testSameMesh(panel));
  CHECK_EXIT_SUCCESS(testSameShape(panel));
  CHECK_EXIT_SUCCESS(testShapeAtDefaults(panel));
  CHECK_EXIT_SUCCESS(testShapeTables(panel));
  CHECK_EXIT_SUCCESS(testNodesOfRun(panel));
  CHECK_EXIT_SUCCESS(testTissueModels(panel));
  CHECK_EXIT_SUCCESS(testSegmentation(panel));
  CHECK_EXIT_SUCCESS(testRoughness(panel));
  CHECK_STD_STRING(host.complaints(), "");
  CHECK_EXIT_SUCCESS(testSceneRestoresPanel(panel));
  return EXIT_SUCCESS;
}
