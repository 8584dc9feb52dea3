// SPDX-License-Identifier: Apache-2.0
// The panel as a user meets it: it says what is missing, runs the module off the interface, and shows, measures and
// exports the same tetrahedra that the command line writes.

#include "HostApplication.h"
#include "HostScene.h"
#include "MeshComparison.h"
#include "MeshIO.h"
#include "MeshedBalls.h"
#include "qSurgicalMesherRunWidget.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"
#include "vtkSlicerFuchsTetrahedralizerLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <ctkSliderWidget.h>
#include <qMRMLCheckableNodeComboBox.h>
#include <qMRMLNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLPlotSeriesNode.h>
#include <vtkMRMLPlotViewNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSliceNode.h>
#include <vtkMRMLTableNode.h>
#include <vtkMRMLTableViewNode.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLFuchsTetrahedralizerNode;
using Logic = vtkSlicerFuchsTetrahedralizerLogic;

namespace
{

struct Panel
{
  HostApplication& host;
  qSlicerAbstractModuleWidget* widget = host.enterPanel("FuchsTetrahedralizer");
  Logic* logic = Logic::SafeDownCast(host.logic("FuchsTetrahedralizer"));
  Node* node = logic->ParameterNode();

  template <class Widget>
  Widget* child(const char* name)
  {
    return findChild<Widget>(widget, name);
  }
  std::string problem() { return child<qSurgicalMesherRunWidget>("RunWidget")->problem().toStdString(); }
  void choose(const char* combo, int index) { child<QComboBox>(combo)->setCurrentIndex(index); }
  bool runToEnd()
  {
    child<QPushButton>("ApplyButton")->click();
    return logic->GetRun()->IsBusy() && host.waitUntil([this] { return !logic->GetRun()->IsBusy(); });
  }
};

int testEmptyPanel(Panel& panel)
{
  CHECK_BOOL(panel.problem().empty(), false);
  CHECK_BOOL(panel.child<QPushButton>("ApplyButton")->isEnabled(), false);
  CHECK_BOOL(panel.child<QPushButton>("ExportButton")->isEnabled(), false);
  CHECK_BOOL(panel.logic->Start(panel.node), false);
  return EXIT_SUCCESS;
}

/// The button beside the problem's sentence takes the only labelled surface; then nothing is missing.
int testFix(Panel& panel, vtkMRMLModelNode* surface)
{
  panel.host.waitFor(0.1);
  panel.widget->enter();
  CHECK_BOOL(panel.child<QPushButton>("FixButton")->isVisible(), true);
  panel.child<QPushButton>("FixButton")->click();
  CHECK_STD_STRING(panel.problem(), "");
  CHECK_POINTER(panel.node->GetNodeReference(Node::SurfaceRole()), surface);
  CHECK_BOOL(panel.child<qMRMLCheckableNodeComboBox>("SurfaceComboBox")->checkState(surface) == Qt::Checked, true);
  return EXIT_SUCCESS;
}

int testRun(Panel& panel, const MeshedBalls& balls, vtkMRMLScalarVolumeNode* scale)
{
  const std::string child = balls.folder + "/child.vtu", shells = balls.folder + "/shells.vtp";
  panel.choose("EdgeLengthSourceComboBox", Node::FromScale);
  CHECK_BOOL(panel.problem().empty(), false);
  panel.child<qMRMLNodeComboBox>("ScaleComboBox")->setCurrentNode(scale);
  panel.child<qMRMLNodeComboBox>("ChildMeshComboBox")->addNode();
  panel.child<qMRMLNodeComboBox>("ShellsComboBox")->addNode();
  CHECK_BOOL(panel.problem().empty(), false); // which tissues become shells?
  panel.node->SetShellTissues("1,2:outside");
  CHECK_STD_STRING(panel.problem(), "");
  panel.child<QCheckBox>("ConditioningCheckBox")->setChecked(true);
  CHECK_BOOL(panel.runToEnd(), true);
  CHECK_STD_STRING(panel.logic->GetRun()->GetErrorText(), "");
  CHECK_INT(panel.logic->GetRun()->GetStatus(), vtkSurgicalMesherRun::Completed);

  runCommandLine("FuchsTetrahedralizerCLI", { "--scale", balls.scale, "--ambient", balls.ambient, "--childMesh", child,
                                              "--shell", "1", "--shell", "2:outside", "--shells", shells, "--export",
                                              balls.folder + "/cli.inp", balls.surface, balls.folder + "/mesh.vtu" });
  runCommandLine("FuchsTetrahedralizerCLI",
                 { "--scale", balls.scale, "--ambient", balls.ambient, "--shell", "1", "--shell", "2:outside",
                   "--elementOrder", "2", "--curvedSides", "--units", "si", "--export", balls.folder + "/curved.inp",
                   balls.surface, balls.folder + "/again.vtu" });
  vtkMRMLModelNode* mesh = panel.node->GetModelNode(Node::MeshRole());
  CHECK_STD_STRING(differenceOf(balls.folder + "/mesh.vtu", mesh), "");
  CHECK_STD_STRING(differenceOf(child, panel.node->GetModelNode(Node::ChildMeshRole())), "");
  CHECK_STD_STRING(differenceOf(shells, panel.node->GetModelNode(Node::ShellsRole())), "");
  writeMesh(meshOfGrid(mesh->GetUnstructuredGrid(), true, "mesh"), balls.folder + "/saved.vtu");
  CHECK_BOOL(sameBytes(balls.folder + "/mesh.vtu", balls.folder + "/saved.vtu"), true);
  return EXIT_SUCCESS;
}

int testTableAndPlots(Panel& panel)
{
  vtkMRMLModelNode* mesh = panel.node->GetModelNode(Node::MeshRole());
  vtkMRMLTableNode* table = Logic::GetQualityTable(mesh);
  CHECK_NOT_NULL(table);
  CHECK_INT(table->GetNumberOfRows(), 5); // mesh, two tissues, parent, child
  CHECK_INT(std::stoi(table->GetCellText(0, 1)), mesh->GetMesh()->GetNumberOfCells());
  CHECK_INT(table->GetNumberOfColumns(), 17); // the last two: conditioning
  for (const int column : { 15, 16 }) CHECK_BOOL(table->GetCellText(0, column).empty(), false);
  for (int n = 0; n < Logic::Histogram_Last; ++n)
  {
    vtkMRMLPlotChartNode* chart = Logic::GetHistogram(mesh, n);
    CHECK_NOT_NULL(chart);
    vtkMRMLTableNode* histogram = chart->GetPlotSeriesNode()->GetTableNode();
    double sum = 0;
    for (int row = 0; row < histogram->GetNumberOfRows(); ++row) sum += std::stod(histogram->GetCellText(row, 1));
    CHECK_DOUBLE_TOLERANCE(sum, 100, 1e-3); // as text
  }
  panel.choose("HistogramComboBox", Logic::RadiusRatios);
  panel.child<QPushButton>("ShowHistogramButton")->click();
  auto* plotView = vtkMRMLPlotViewNode::SafeDownCast(panel.host.scene()->GetFirstNodeByClass("vtkMRMLPlotViewNode"));
  CHECK_POINTER(plotView->GetPlotChartNode(), Logic::GetHistogram(mesh, Logic::RadiusRatios));
  panel.child<QPushButton>("ShowTableButton")->click();
  auto* tableView = vtkMRMLTableViewNode::SafeDownCast(panel.host.scene()->GetFirstNodeByClass("vtkMRMLTableViewNode"));
  CHECK_POINTER(tableView->GetTableNode(), table);
  return EXIT_SUCCESS;
}

int testColors(Panel& panel)
{
  vtkMRMLModelNode* mesh = panel.node->GetModelNode(Node::MeshRole());
  vtkMRMLModelDisplayNode* display = mesh->GetModelDisplayNode();
  const std::pair<const char*, double> expected[] = { { "TissueLabel", 2 },
                                                      { "SubMesh", 1 },
                                                      { "Constitutive", 2 },
                                                      { "MinimumDihedralAngle", 70.53 },
                                                      { "RadiusRatio", 1 } };
  for (int pass = 0; pass < 2; ++pass) // the second makes no further nodes
  {
    const int nodes = panel.host.scene()->GetNumberOfNodes();
    for (int colorBy = 0; colorBy < Node::ColorBy_Last; ++colorBy)
    {
      panel.choose("ColorComboBox", colorBy);
      CHECK_STRING(display->GetActiveScalarName(), expected[colorBy].first);
      CHECK_DOUBLE(display->GetScalarRange()[1], expected[colorBy].second);
      CHECK_BOOL(display->GetScalarVisibility(), true);
      const double* range = mesh->GetMesh()->GetCellData()->GetArray(expected[colorBy].first)->GetRange();
      CHECK_BOOL(range[0] >= 0 && range[1] <= expected[colorBy].second, true);
    }
    if (pass == 1) CHECK_INT(panel.host.scene()->GetNumberOfNodes(), nodes);
  }
  return EXIT_SUCCESS;
}

int testClipping(Panel& panel)
{
  vtkMRMLModelNode* mesh = panel.node->GetModelNode(Node::MeshRole());
  panel.choose("ClipPlaneComboBox", Node::NoPlane);
  CHECK_BOOL(mesh->GetDisplayNode()->GetClipping(), false);
  CHECK_BOOL(panel.child<ctkSliderWidget>("ClipSlider")->isEnabled(), false);
  panel.choose("ClipPlaneComboBox", Node::Axial);
  CHECK_BOOL(mesh->GetDisplayNode()->GetClipping(), true);
  auto* slider = panel.child<ctkSliderWidget>("ClipSlider");
  CHECK_DOUBLE_TOLERANCE(slider->minimum(), -10, 1.5);
  CHECK_DOUBLE_TOLERANCE(slider->maximum(), 10, 1.5);
  slider->setValue(3);
  auto* slice = vtkMRMLSliceNode::SafeDownCast(panel.host.scene()->GetNodeByID("vtkMRMLSliceNodeRed"));
  CHECK_DOUBLE(slice->GetSliceOffset(), 3);
  slice->SetSliceOffset(-2);
  CHECK_DOUBLE(slider->value(), -2);
  return EXIT_SUCCESS;
}

int testExport(Panel& panel, const MeshedBalls& balls)
{
  const std::string file = balls.folder + "/cli.inp", again = balls.folder + "/panel/cli.inp";
  CHECK_BOOL(QMetaObject::invokeMethod(panel.widget, "exportMesh", Q_ARG(QString, QString::fromStdString(again))),
             true);
  CHECK_BOOL(sameBytes(file, again), false); // there is no such folder
  newFolder("qSlicerFuchsTetrahedralizerModuleWidgetTest/panel");
  CHECK_BOOL(QMetaObject::invokeMethod(panel.widget, "exportMesh", Q_ARG(QString, QString::fromStdString(again))),
             true);
  CHECK_BOOL(sameBytes(file, again), true);
  CHECK_BOOL(sameBytes(file + ".names.json", again + ".names.json"), true);
  panel.child<QComboBox>("ExportElementsComboBox")->setCurrentIndex(2);
  panel.child<QComboBox>("ExportUnitsComboBox")->setCurrentIndex(1);
  const std::string curved = balls.folder + "/panel/curved.inp";
  CHECK_STD_STRING(panel.logic->Export(panel.node, curved), "");
  CHECK_BOOL(sameBytes(balls.folder + "/curved.inp", curved), true);
  panel.node->SetExportElements(Node::FourNodes);
  panel.node->SetExportUnits(Node::Millimetres);
  for (const Logic::Format& format : Logic::GetExportFormats())
    CHECK_STD_STRING(panel.logic->Export(panel.node, balls.folder + "/panel/all" + format.extension), "");
  CHECK_BOOL(panel.logic->Export(panel.node, balls.folder + "/panel/mesh.xyz").empty(), false);
  return EXIT_SUCCESS;
}

int testPanel()
{
  HostApplication host;
  const MeshedBalls balls = meshBalls(host.scene(), "qSlicerFuchsTetrahedralizerModuleWidgetTest");
  Panel panel{ host };
  CHECK_EXIT_SUCCESS(testEmptyPanel(panel));
  vtkMRMLModelNode* surface = loadSurface(host.scene(), balls);
  vtkMRMLScalarVolumeNode* scale = loadVolume(host.scene(), balls.scale, "scale");
  CHECK_EXIT_SUCCESS(testFix(panel, surface));
  CHECK_EXIT_SUCCESS(testRun(panel, balls, scale));
  CHECK_EXIT_SUCCESS(testTableAndPlots(panel));
  CHECK_EXIT_SUCCESS(testColors(panel));
  CHECK_EXIT_SUCCESS(testClipping(panel));
  CHECK_EXIT_SUCCESS(testExport(panel, balls));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerFuchsTetrahedralizerModuleWidgetTest(int, char*[])
{
  try
  {
    return testPanel();
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
