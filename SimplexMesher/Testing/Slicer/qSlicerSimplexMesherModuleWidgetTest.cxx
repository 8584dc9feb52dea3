// SPDX-License-Identifier: Apache-2.0
// The panel as a user meets it: it says what is missing, lists the tissues, and its runs leave the nodes that they
// should, with the very mesh that the command line writes.

#include "MeshComparison.h"
#include "MeshIO.h"
#include "Panel.h"

#include <ctkSliderWidget.h>

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
  CHECK_EXIT_SUCCESS(testSameMesh(panel));
  CHECK_EXIT_SUCCESS(testNodesOfRun(panel));
  CHECK_EXIT_SUCCESS(testTissueModels(panel));
  CHECK_EXIT_SUCCESS(testSegmentation(panel));
  CHECK_STD_STRING(host.complaints(), "");
  CHECK_EXIT_SUCCESS(testSceneRestoresPanel(panel));
  return EXIT_SUCCESS;
}
