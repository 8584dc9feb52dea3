// SPDX-License-Identifier: Apache-2.0
// The panel in the host: filled by its controls, run by its buttons, and put into every wrong state.

#include "HostScene.h"
#include "MarkupsInput.h"
#include "MeshComparison.h"
#include "Panel.h"
#include "TissueMapIO.h"
#include "TissueMapInput.h"
#include "vtkMRMLSimplexMesherNode.h"

#include <qSlicerMarkupsPlaceWidget.h>

#include <vtkMRMLBSplineTransformNode.h>
#include <vtkMRMLColorNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLSliceCompositeNode.h>
#include <vtkMRMLTransformNode.h>

#include <QCheckBox>
#include <QTableWidget>

#include <cmath>
#include <fstream>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLTissueMapperNode;
using Run = vtkSurgicalMesherRun;

namespace
{

/// A head of nested balls with fifteen points a class, placed by the panel.
struct Inputs
{
  HeadPhantom head = headPhantom(3);
  vtkMRMLScalarVolumeNode* image = nullptr;
  vtkMRMLMarkupsNode* training = nullptr;
};

void placePoints(const Panel& panel, vtkMRMLMarkupsNode* training, const TissueMap& truth)
{
  for (const TissueClass& tissue : trainingOf(truth, 15))
  {
    panel.chooseClass(tissue.name);
    for (const Vec3& p : tissue.points) training->AddControlPoint(-p.x, -p.y, p.z); // as a click in a view does
  }
}

Inputs fill(const Panel& panel)
{
  Inputs inputs;
  inputs.image = addVolume(panel.host.scene(), "T1", inputs.head.image);
  inputs.training = addMarkups(panel.host.scene(), "vtkMRMLMarkupsFiducialNode", {});
  panel.choose("ImageSelector", inputs.image);
  panel.choose("TrainingSelector", inputs.training);
  placePoints(panel, inputs.training, inputs.head.truth);
  return inputs;
}

/// Long enough to be cancelled.
void makeSlow(const Panel& panel)
{
  panel.child<QCheckBox>("DenoiseCheckBox")->setChecked(true);
  panel.child<QCheckBox>("CorrectBiasCheckBox")->setChecked(true);
}

void clear(const Panel& panel)
{
  panel.host.scene()->Clear(0);
  panel.host.waitFor(0.1);
}

/// What the command line makes of the same images and points, from files.
TissueMap runFromFiles(const std::string& name, const Inputs& inputs, std::vector<std::string> arguments)
{
  const std::string folder = newFolder(name);
  writeImage(inputs.head.image, folder + "/t1.nrrd");
  writeImage(ctOf(inputs.head, 20), folder + "/ct.nrrd");
  writeLabelledMarkups({ labelledPoints(inputs.training) }, folder + "/points.mrk.json");
  for (std::string& argument : arguments)
  {
    if (argument == "ct.nrrd") argument = folder + "/" + argument;
  }
  for (const char* file : { "/t1.nrrd", "/map.nrrd" }) arguments.push_back(folder + file);
  arguments.insert(arguments.begin(), { "--training", folder + "/points.mrk.json" });
  runCommandLine("TissueMapperCLI", arguments);
  return readTissueMap(folder + "/map.nrrd");
}

//--- The straight road ------------------------------------------------------

int checkApply(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  const LeftoverCheck nodes(panel.host.scene());
  const std::set<std::string> files = temporaryFiles();
  CHECK_STD_STRING(panel.problem(), "");
  CHECK_BOOL(panel.child<QPushButton>("MesherButton")->isEnabled(), false);
  panel.apply();
  CHECK_BOOL(panel.run->IsBusy(), true);
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  CHECK_INT(panel.run->GetStatus(), Run::Completed);

  vtkMRMLLabelMapVolumeNode* tissues = panel.node()->GetLabelMapNode(Node::LabelMapRole());
  CHECK_NOT_NULL(tissues);
  const TissueMap found = readTissueMap(tissues), expected = runFromFiles("TissueMapperApply", inputs, {});
  CHECK_BOOL(found.labels == expected.labels, true);
  CHECK_STD_STRING(found.table.at(2).name, "grey matter");
  CHECK_STD_STRING(found.table.at(7).name, "skull");
  for (int part = 0; part < 3; ++part)
    CHECK_BOOL(std::abs(found.table.at(7).color[part] - expected.table.at(7).color[part]) < 0.01, true);
  std::size_t right = 0;
  for (std::size_t n = 0; n < found.labels.size(); ++n) right += found.labels[n] == inputs.head.truth.labels[n];
  CHECK_BOOL(double(right) > 0.97 * double(found.labels.size()), true);
  CHECK_BOOL(panel.sentence().find("Classified in") == 0, true);
  auto* view =
    vtkMRMLSliceCompositeNode::SafeDownCast(panel.host.scene()->GetFirstNodeByClass("vtkMRMLSliceCompositeNode"));
  CHECK_STRING(view->GetLabelVolumeID(), tissues->GetID());
  CHECK_STD_STRING(
    nodes.leftovers({ "vtkMRMLLabelMapVolumeNode", "vtkMRMLLabelMapVolumeDisplayNode", "vtkMRMLColorTableNode" }), "");

  // The same output once more: filled again, none is added.
  const LeftoverCheck second(panel.host.scene());
  panel.child<QCheckBox>("UseCompartmentsCheckBox")->setChecked(false);
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  CHECK_STD_STRING(second.leftovers(), "");
  CHECK_POINTER(panel.node()->GetLabelMapNode(Node::LabelMapRole()), tissues);
  CHECK_BOOL(readTissueMap(tissues).labels ==
               runFromFiles("TissueMapperApplyAgain", inputs, { "--noCompartments" }).labels,
             true);

  panel.child<QPushButton>("MesherButton")->click();
  auto* mesher =
    vtkMRMLSimplexMesherNode::SafeDownCast(panel.host.scene()->GetFirstNodeByClass("vtkMRMLSimplexMesherNode"));
  CHECK_NOT_NULL(mesher);
  CHECK_POINTER(mesher->GetNodeReference(vtkMRMLSimplexMesherNode::TissueMapRole()), tissues);
  clear(panel);
  CHECK_BOOL(temporaryFiles() == files, true);
  return EXIT_SUCCESS;
}

/// Two images and the points under one transform, and a table of classes: labels are the table's.
int checkTwoImages(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  vtkMRMLScalarVolumeNode* ct = addVolume(panel.host.scene(), "CT", ctOf(inputs.head, 20));
  panel.choose("FourthImageSelector", ct);
  const std::string table = newFolder("TissueMapperTable") + "/classes.csv";
  std::ofstream(table) << "label,name\n11,CSF\n12,grey matter\n13,white matter\n24,fat\n25,muscle\n26,skin\n40,skull\n";
  panel.node()->SetClasses(table);
  const TissueMap expected = runFromFiles("TissueMapperTwo", inputs, { "--channel", "ct.nrrd", "--classes", table });
  vtkMRMLTransformNode* transform = addTransform(panel.host.scene());
  for (vtkMRMLTransformableNode* node :
       { static_cast<vtkMRMLTransformableNode*>(inputs.image), static_cast<vtkMRMLTransformableNode*>(ct),
         static_cast<vtkMRMLTransformableNode*>(inputs.training) })
    node->SetAndObserveTransformNodeID(transform->GetID());
  CHECK_STD_STRING(panel.problem(), "");
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  const TissueMap found = readTissueMap(panel.node()->GetLabelMapNode(Node::LabelMapRole()));
  CHECK_BOOL(presentLabels(found) == std::vector<Label>({ 11, 12, 13, 24, 25, 26, 40 }), true);
  CHECK_STD_STRING(found.table.at(40).name, "skull");
  std::size_t same = 0; // the turned grid's axes are rounded
  for (std::size_t n = 0; n < found.labels.size(); ++n) same += found.labels[n] == expected.labels[n];
  CHECK_BOOL(double(same) > 0.99 * double(found.labels.size()), true);
  clear(panel);
  return EXIT_SUCCESS;
}

//--- Placing ----------------------------------------------------------------

int checkPlacing(const Panel& panel)
{
  panel.choose("ImageSelector", addVolume(panel.host.scene(), "T1", headPhantom(3).image));
  CHECK_BOOL(panel.problem().empty(), false);
  panel.fix(); // place points
  vtkMRMLMarkupsNode* training = panel.node()->GetMarkupsNode(Node::TrainingRole());
  CHECK_NOT_NULL(training);
  CHECK_BOOL(panel.child<qSlicerMarkupsPlaceWidget>("TrainingPlaceWidget")->placeModeEnabled(), true);
  auto* table = panel.child<QTableWidget>("ClassTable");
  const auto cell = [table](int row, int column) { return table->item(row, column)->text().toStdString(); };

  training->AddControlPoint(0, 0, 0); // the first class is chosen from the start
  panel.chooseClass("skull");
  training->AddControlPoint(0, 0, 22);
  training->AddControlPoint(0, 0, 23);
  CHECK_INT(table->rowCount(), 2);
  CHECK_STD_STRING(cell(0, 0), "CSF");
  CHECK_STD_STRING(cell(1, 0), "skull");
  CHECK_STD_STRING(cell(1, 1), "2");
  CHECK_STD_STRING(panel.problem(), "");

  // A point that follows the mouse is of the class that is chosen when it is placed.
  const int preview = training->AddControlPoint(1, 2, 3);
  training->SetNthControlPointPosition(preview, 1, 2, 3, vtkMRMLMarkupsNode::PositionPreview);
  CHECK_STD_STRING(cell(1, 1), "2");
  panel.chooseClass("pituitary 100 %d");
  training->SetNthControlPointPosition(preview, 1, 2, 3, vtkMRMLMarkupsNode::PositionDefined);
  CHECK_STD_STRING(cell(2, 0), "pituitary 100 d");
  CHECK_BOOL(panel.child<QComboBox>("ClassComboBox")->findText("pituitary 100 d") >= 0, true);
  emit table->cellClicked(1, 0);
  CHECK_STD_STRING(panel.node()->GetTrainingClass(), "skull");
  training->AddControlPoint(0, 0, 24);
  CHECK_STD_STRING(cell(1, 1), "3");
  training->RemoveAllControlPoints();
  CHECK_INT(table->rowCount(), 0);

  panel.host.leavePanel();
  CHECK_BOOL(panel.child<qSlicerMarkupsPlaceWidget>("TrainingPlaceWidget")->placeModeEnabled(), false);
  panel.host.enterPanel("TissueMapper");
  clear(panel);
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
  const Inputs inputs = fill(panel);
  panel.host.waitFor(0.1);
  panel.choose("ImageSelector", nullptr);
  CHECK_BOOL(isRefused(), true); // there, and not chosen
  panel.fix();
  CHECK_POINTER(panel.node()->GetNodeReference(Node::ImageRole()), inputs.image);
  CHECK_STD_STRING(panel.problem(), "");
  panel.choose("TrainingSelector", nullptr);
  CHECK_BOOL(isRefused(), true);
  panel.choose("TrainingSelector", addMarkups(panel.host.scene(), "vtkMRMLMarkupsFiducialNode", { Point{ 0, 0, 22 } }));
  CHECK_BOOL(isRefused(), true); // one class
  panel.choose("TrainingSelector", inputs.training);
  inputs.training->SetNthControlPointLabel(0, " ");
  CHECK_BOOL(isRefused(), true);
  inputs.training->SetNthControlPointLabel(0, "CSF");
  CHECK_STD_STRING(panel.problem(), "");
  panel.node()->SetClasses("/no/such/file.csv");
  CHECK_BOOL(isRefused(), true);
  panel.fix();
  const std::string table = newFolder("TissueMapperSentences") + "/classes.csv";
  std::ofstream(table) << "label,name\n1,CSF\n";
  panel.node()->SetClasses(table);
  CHECK_BOOL(isRefused(), true); // leaves classes out
  panel.node()->SetClasses({});
  ScalarImage shifted = ctOf(inputs.head, 20);
  shifted.grid.origin.x += 1;
  vtkMRMLScalarVolumeNode* ct = addVolume(panel.host.scene(), "CT", shifted);
  panel.choose("ThirdImageSelector", ct);
  CHECK_BOOL(isRefused(), true);
  panel.fix();
  CHECK_STD_STRING(panel.problem(), "");
  CHECK_NULL(panel.node()->GetNodeReference(Node::ThirdImageRole()));
  vtkMRMLNode* warp = panel.host.scene()->AddNewNodeByClass("vtkMRMLBSplineTransformNode");
  inputs.image->SetAndObserveTransformNodeID(warp->GetID());
  CHECK_BOOL(isRefused(), true);
  inputs.image->SetAndObserveTransformNodeID(nullptr);
  CHECK_STD_STRING(panel.problem(), "");

  // What only the module finds out.
  inputs.training->AddControlPoint(500, 0, 0);
  CHECK_STD_STRING(panel.problem(), "");
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Failed);
  CHECK_BOOL(panel.sentence().find("lies outside the image") != std::string::npos, true);
  panel.host.complaints(); // the host's own, on the module's status
  CHECK_NULL(panel.node()->GetLabelMapNode(Node::LabelMapRole()));
  clear(panel);
  CHECK_STD_STRING(panel.node()->GetTrainingClass(), "CSF"); // the panel starts anew
  return EXIT_SUCCESS;
}

int checkCancel(const Panel& panel)
{
  fill(panel);
  makeSlow(panel);
  const LeftoverCheck nodes(panel.host.scene());
  for (const double delay : { 0.0, 0.15, 0.4, 0.8 })
  {
    panel.apply();
    panel.host.waitFor(delay);
    CHECK_BOOL(panel.run->IsBusy(), true);
    panel.button("CancelButton")->click();
    CHECK_BOOL(panel.waitForEnd(), true);
    CHECK_INT(panel.run->GetStatus(), Run::Cancelled);
    CHECK_STD_STRING(nodes.leftovers(), "");
    CHECK_NULL(panel.node()->GetLabelMapNode(Node::LabelMapRole()));
    CHECK_STD_STRING(panel.sentence(), "Cancelled.");
  }
  clear(panel);
  return EXIT_SUCCESS;
}

int checkSceneClosed(const Panel& panel)
{
  const std::set<std::string> files = temporaryFiles();
  for (const double delay : { 0.0, 0.3, 0.8 })
  {
    fill(panel);
    makeSlow(panel);
    panel.apply();
    panel.host.waitFor(delay);
    panel.host.scene()->Clear(0);
    CHECK_BOOL(panel.run->IsBusy(), false);
    panel.host.waitFor(0.5);
    CHECK_NULL(panel.host.scene()->GetFirstNodeByClass("vtkMRMLCommandLineModuleNode"));
    CHECK_NULL(panel.host.scene()->GetFirstNodeByClass("vtkMRMLLabelMapVolumeNode"));
    CHECK_BOOL(panel.problem().empty(), false);
    CHECK_INT(panel.child<QTableWidget>("ClassTable")->rowCount(), 0);
  }
  CHECK_BOOL(temporaryFiles() == files, true);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerTissueMapperModuleWidgetTest(int, char*[])
{
  HostApplication host;
  const Panel panel{ host };
  for (const auto check : { checkSentences, checkPlacing, checkApply, checkTwoImages, checkCancel, checkSceneClosed })
  {
    CHECK_EXIT_SUCCESS(check(panel));
    CHECK_STD_STRING(host.complaints(), "");
  }
  return EXIT_SUCCESS;
}
