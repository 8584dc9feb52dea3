// SPDX-License-Identifier: Apache-2.0
// The panel in the host: filled by its controls, run by its buttons, and put into every wrong state.

#include "HostApplication.h"
#include "HostScene.h"
#include "MarkupsInput.h"
#include "MeshComparison.h"
#include "TissueMapIO.h"
#include "qSurgicalMesherRunWidget.h"
#include "vtkMRMLSurgicalPathScaleNode.h"
#include "vtkSlicerSurgicalPathScaleLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <ctkSliderWidget.h>
#include <qMRMLNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerMarkupsPlaceWidget.h>

#include <vtkMRMLColorNode.h>
#include <vtkMRMLCommandLineModuleNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLPlotSeriesNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLSliceCompositeNode.h>
#include <vtkMRMLTableNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkTable.h>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>

#include <cmath>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLSurgicalPathScaleNode;
using Run = vtkSurgicalMesherRun;

namespace
{

/// The panel, by what a user does with it.
struct Panel
{
  explicit Panel(HostApplication& application)
    : host(application), widget(application.enterPanel("SurgicalPathScale")),
      logic(vtkSlicerSurgicalPathScaleLogic::SafeDownCast(application.logic("SurgicalPathScale"))), run(logic->GetRun())
  {
  }

  HostApplication& host;
  qSlicerAbstractModuleWidget* widget;
  vtkSlicerSurgicalPathScaleLogic* logic;
  Run* run;

  Node* node() const { return logic->ParameterNode(); }
  template <class Child>
  Child* child(const char* name) const
  {
    return findChild<Child>(widget, name);
  }
  void choose(const char* selector, vtkMRMLNode* chosen) const
  {
    child<qMRMLNodeComboBox>(selector)->setCurrentNode(chosen);
  }
  void slide(const char* slider, double value) const { child<ctkSliderWidget>(slider)->setValue(value); }
  void spin(const char* box, double value) const { child<QDoubleSpinBox>(box)->setValue(value); }
  QPushButton* applyButton() const { return child<QPushButton>("ApplyButton"); }
  QPushButton* cancelButton() const { return child<QPushButton>("CancelButton"); }
  std::string problem() const { return child<qSurgicalMesherRunWidget>("RunWidget")->problem().toStdString(); }
  std::string sentence() const { return child<QLabel>("RunSentence")->text().toStdString(); }
  void fix() const { child<QPushButton>("FixButton")->click(); }
  bool waitForEnd() const
  {
    return host.waitUntil([this] { return !run->IsBusy(); });
  }
  bool waitForProcess() const
  {
    return host.waitUntil(
      [this]
      { return !run->IsBusy() || run->GetCommandLineNode()->GetStatus() == vtkMRMLCommandLineModuleNode::Running; });
  }
};

/// What every test here begins with: balls, one target, one path.
struct Inputs
{
  vtkMRMLLabelMapVolumeNode* labelMap;
  vtkMRMLMarkupsNode* targets;
  vtkMRMLMarkupsNode* path;
};

Inputs fill(const Panel& panel)
{
  vtkMRMLScene* scene = panel.host.scene();
  Inputs inputs;
  inputs.labelMap = addNestedBalls(scene);
  inputs.targets = addMarkups(scene, "vtkMRMLMarkupsFiducialNode", { Point{ 1, 2, 3 } });
  inputs.path = addMarkups(scene, "vtkMRMLMarkupsLineNode", { Point{ 0, 12, 0 }, Point{ 1, 2, 3 } });
  panel.choose("TissueMapSelector", inputs.labelMap);
  panel.choose("TargetsSelector", inputs.targets);
  panel.choose("PathSelector", inputs.path);
  panel.slide("MinimumEdgeLengthSlider", 0.5);
  panel.slide("MaximumEdgeLengthSlider", 3);
  panel.slide("ChildRadiusSlider", 2);
  panel.slide("DecayLengthSlider", 5);
  return inputs;
}

/// Long enough to be cancelled.
void makeSlow(const Panel& panel) { panel.spin("SpacingSpinBox", 0.1); }

void clear(const Panel& panel)
{
  panel.host.scene()->Clear(0);
  panel.host.waitFor(0.1);
}

double largestDifference(vtkMRMLVolumeNode* node, const ScaleField& field)
{
  vtkImageData* image = node->GetImageData();
  int size[3];
  image->GetDimensions(size);
  if (size[0] != field.grid.size[0] || size[1] != field.grid.size[1] || size[2] != field.grid.size[2]) return INFINITY;
  double largest = 0;
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        const double difference =
          image->GetScalarComponentAsDouble(i, j, k, 0) - double(field.lengths[field.grid.index(i, j, k)]);
        largest = std::max(largest, std::abs(difference));
      }
    }
  }
  return largest;
}

/// What the command line makes of the same parameters, from files.
ScaleField runFromFiles(const Panel& panel, const std::string& folder, const std::vector<std::string>& more)
{
  Node* node = panel.node();
  const TissueMap map = readTissueMap(node->GetNodeReference(Node::TissueMapRole()));
  writeTissueMap(map, folder + "/map.nrrd");
  writeMarkups({ markupsPoints(node->GetTargetNodes()[0]) }, folder + "/targets.mrk.json");
  writeMarkups({ markupsPath(node->GetPathNodes()[0]) }, folder + "/path.mrk.json");
  std::vector<std::string> arguments{ "--minimumEdgeLength",
                                      "0.5",
                                      "--maximumEdgeLength",
                                      "3",
                                      "--childRadius",
                                      "2",
                                      "--decayLength",
                                      "5",
                                      "--targets",
                                      folder + "/targets.mrk.json",
                                      "--path",
                                      folder + "/path.mrk.json" };
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.push_back(folder + "/map.nrrd");
  arguments.push_back(folder + "/scale.nrrd");
  runCommandLine("SurgicalPathScaleCLI", arguments);
  return readScale(folder + "/scale.nrrd");
}

//--- The straight road ------------------------------------------------------

int checkApply(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  panel.spin("NullDisplacementRadiusSpinBox", 6);
  const LeftoverCheck nodes(panel.host.scene());
  const std::set<std::string> files = temporaryFiles();
  CHECK_STD_STRING(panel.problem(), "");
  CHECK_BOOL(panel.applyButton()->isEnabled(), true);
  panel.applyButton()->click();
  CHECK_BOOL(panel.run->IsBusy(), true);
  CHECK_BOOL(panel.applyButton()->isEnabled(), false);
  CHECK_BOOL(panel.cancelButton()->isEnabled(), true);
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  CHECK_INT(panel.run->GetStatus(), Run::Completed);

  vtkMRMLScalarVolumeNode* scale = panel.node()->GetScalarVolumeNode(Node::ScaleRole());
  CHECK_NOT_NULL(scale);
  const std::string folder = newFolder("SurgicalPathScaleApply");
  const ScaleField expected =
    runFromFiles(panel, folder, { "--nullDisplacementRadius", "6", "--outputLabelMap", folder + "/held.nrrd" });
  CHECK_DOUBLE(largestDifference(scale, expected), 0);

  vtkMRMLLabelMapVolumeNode* held = panel.node()->GetLabelMapNode(Node::OutputLabelMapRole());
  CHECK_NOT_NULL(held);
  CHECK_BOOL(readTissueMap(held).labels == readTissueMap(folder + "/held.nrrd").labels, true);
  vtkMRMLColorNode* colors = held->GetDisplayNode()->GetColorNode();
  CHECK_STRING(colors->GetColorName(1), "tumour");
  CHECK_STRING(colors->GetColorName(3), "null displacement");
  CHECK_BOOL(readTissueMap(held).table.at(3).isNullDisplacement, true);
  CHECK_BOOL(panel.sentence().find("triangles") != std::string::npos, true);
  CHECK_STD_STRING(
    nodes.leftovers({ "vtkMRMLScalarVolumeNode", "vtkMRMLScalarVolumeDisplayNode", "vtkMRMLLabelMapVolumeNode",
                      "vtkMRMLLabelMapVolumeDisplayNode", "vtkMRMLColorTableNode", "vtkMRMLColorLegendDisplayNode" }),
    "");

  // The same outputs once more: filled again, none is added.
  const LeftoverCheck second(panel.host.scene());
  panel.slide("MaximumEdgeLengthSlider", 2);
  panel.applyButton()->click();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  CHECK_STD_STRING(second.leftovers(), "");
  CHECK_POINTER(panel.node()->GetScalarVolumeNode(Node::ScaleRole()), scale);
  CHECK_BOOL(scale->GetImageData()->GetScalarRange()[1] <= 2, true);
  CHECK_POINTER(panel.node()->GetNodeReference(Node::TissueMapRole()), inputs.labelMap);
  clear(panel);
  CHECK_BOOL(temporaryFiles() == files, true);
  return EXIT_SUCCESS;
}

/// A segmentation and a label map of the same tissues, under a transform, give the same.
int checkSegmentation(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  vtkMRMLTransformNode* transform = addTransform(panel.host.scene());
  vtkMRMLSegmentationNode* segmentation = addSegmentation(panel.host.scene(), inputs.labelMap);
  inputs.labelMap->SetAndObserveTransformNodeID(transform->GetID());
  segmentation->SetAndObserveTransformNodeID(transform->GetID());
  inputs.path->SetAndObserveTransformNodeID(transform->GetID());
  const TissueMap fromLabels = readTissueMap(inputs.labelMap);
  const TissueMap fromSegments = readTissueMap(segmentation);
  CHECK_BOOL(fromLabels.labels == fromSegments.labels, true);
  CHECK_BOOL(norm(fromLabels.grid.origin - fromSegments.grid.origin) < 1e-6, true);

  panel.choose("TissueMapSelector", segmentation);
  CHECK_STD_STRING(panel.problem(), "");
  panel.applyButton()->click();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  const ScaleField expected = runFromFiles(panel, newFolder("SurgicalPathScaleSegmentation"), {});
  CHECK_BOOL(largestDifference(panel.node()->GetScalarVolumeNode(Node::ScaleRole()), expected) < 1e-5, true);
  clear(panel);
  return EXIT_SUCCESS;
}

//--- Preview, plot, estimate ------------------------------------------------

std::vector<vtkMRMLSliceCompositeNode*> views(const Panel& panel)
{
  std::vector<vtkMRMLNode*> nodes;
  panel.host.scene()->GetNodesByClass("vtkMRMLSliceCompositeNode", nodes);
  std::vector<vtkMRMLSliceCompositeNode*> found;
  for (vtkMRMLNode* node : nodes) found.push_back(vtkMRMLSliceCompositeNode::SafeDownCast(node));
  return found;
}

std::string textOf(const char* text) { return text ? text : ""; }

int checkPreview(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  const std::vector<vtkMRMLSliceCompositeNode*> slices = views(panel);
  CHECK_BOOL(slices.empty(), false);
  slices[0]->SetForegroundOpacity(0.25);
  slices[0]->SetLabelVolumeID(inputs.labelMap->GetID());
  panel.spin("NullDisplacementRadiusSpinBox", 6);
  const LeftoverCheck nodes(panel.host.scene());
  auto* box = panel.child<QCheckBox>("PreviewCheckBox");
  box->setChecked(true);
  vtkMRMLScalarVolumeNode* preview = panel.logic->GetPreviewScaleNode();
  CHECK_NOT_NULL(preview);
  for (vtkMRMLSliceCompositeNode* slice : slices)
  {
    CHECK_STRING(slice->GetForegroundVolumeID(), preview->GetID());
    CHECK_STRING(slice->GetLabelVolumeID(), panel.logic->GetPreviewNullDisplacementNode()->GetID());
  }
  panel.host.scene()->SetSaveToXMLString(1);
  panel.host.scene()->Commit();
  const std::string saved = panel.host.scene()->GetSceneXMLString();
  panel.host.scene()->SetSaveToXMLString(0);
  CHECK_BOOL(saved.find(panel.node()->GetID()) != std::string::npos, true);
  CHECK_BOOL(saved.find(preview->GetName()) == std::string::npos, true);
  CHECK_BOOL(std::abs(preview->GetImageData()->GetScalarRange()[0] - 0.5) < 0.05, true);
  panel.slide("MinimumEdgeLengthSlider", 1.5); // followed, a moment later
  CHECK_BOOL(panel.host.waitUntil([&] { return preview->GetImageData()->GetScalarRange()[0] >= 1.5; }), true);
  inputs.targets->SetNthControlPointPosition(0, 100, 100, 100);
  panel.choose("PathSelector", nullptr);
  CHECK_BOOL(panel.host.waitUntil([&] { return preview->GetImageData()->GetScalarRange()[0] > 2.9; }), true);

  box->setChecked(false);
  CHECK_STD_STRING(nodes.leftovers(), "");
  CHECK_STD_STRING(textOf(slices[0]->GetForegroundVolumeID()), "");
  CHECK_DOUBLE(slices[0]->GetForegroundOpacity(), 0.25);
  CHECK_STRING(slices[0]->GetLabelVolumeID(), inputs.labelMap->GetID());

  box->setChecked(true);
  panel.host.leavePanel();
  CHECK_STD_STRING(nodes.leftovers(), "");
  panel.host.enterPanel("SurgicalPathScale");
  CHECK_BOOL(panel.host.waitUntil([&] { return panel.logic->IsPreviewShown(); }), true);
  panel.applyButton()->click();
  panel.host.leavePanel(); // while the host's thread still looks for the run's nodes in the scene
  if (panel.run->IsStarting()) CHECK_BOOL(panel.logic->IsPreviewShown(), true);
  CHECK_BOOL(panel.host.waitUntil([&] { return !panel.logic->IsPreviewShown(); }), true);
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  CHECK_BOOL(panel.logic->IsPreviewShown(), false);
  panel.host.enterPanel("SurgicalPathScale");
  box->setChecked(true);
  CHECK_BOOL(panel.host.waitUntil([&] { return panel.logic->IsPreviewShown(); }), true);
  inputs.labelMap->GetScene()->RemoveNode(inputs.labelMap); // its input goes: so does the preview
  CHECK_BOOL(panel.host.waitUntil([&] { return !panel.logic->IsPreviewShown(); }), true);
  box->setChecked(false);
  clear(panel);
  return EXIT_SUCCESS;
}

int checkPlotAndEstimate(const Panel& panel)
{
  fill(panel);
  auto* label = panel.child<QLabel>("EstimateLabel");
  CHECK_BOOL(panel.host.waitUntil([&] { return label->text().contains("tetrahedra"); }), true);
  const vtkSlicerSurgicalPathScaleLogic::Estimate estimate = panel.logic->EstimateMesh(panel.node());
  const LeftoverCheck nodes(panel.host.scene());
  auto* box = panel.child<QCheckBox>("ProfileCheckBox");
  box->setChecked(true);
  vtkMRMLPlotChartNode* chart = panel.node()->GetPlotChartNode(Node::ProfileChartRole());
  CHECK_NOT_NULL(chart);
  const auto last = [&]
  {
    vtkTable* table = chart->GetNthPlotSeriesNode(0)->GetTableNode()->GetTable();
    return table->GetValue(table->GetNumberOfRows() - 1, 1).ToDouble();
  };
  CHECK_BOOL(last() > 2.9 && last() < 3, true);
  panel.slide("MaximumEdgeLengthSlider", 6);
  CHECK_BOOL(last() > 5.8 && last() < 6, true);
  box->setChecked(false);
  CHECK_STD_STRING(nodes.leftovers({ "vtkMRMLPlotViewNode" }), "");

  panel.slide("MaximumEdgeLengthSlider", 3);
  panel.applyButton()->click();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_BOOL(std::abs(panel.logic->GetEstimateOfRun().tetrahedra / estimate.tetrahedra - 1) < 0.01, true);
  clear(panel);
  return EXIT_SUCCESS;
}

int checkPlacing(const Panel& panel)
{
  panel.choose("TissueMapSelector", addNestedBalls(panel.host.scene()));
  CHECK_BOOL(panel.problem().empty(), false);
  panel.fix(); // place targets
  CHECK_INT(int(panel.node()->GetTargetNodes().size()), 1);
  CHECK_BOOL(panel.child<qSlicerMarkupsPlaceWidget>("TargetsPlaceWidget")->placeModeEnabled(), true);
  panel.node()->GetTargetNodes()[0]->AddControlPoint(0, 0, 0); // as a click in a view does
  CHECK_STD_STRING(panel.problem(), "");
  panel.host.leavePanel();
  CHECK_BOOL(panel.child<qSlicerMarkupsPlaceWidget>("TargetsPlaceWidget")->placeModeEnabled(), false);
  panel.host.enterPanel("SurgicalPathScale");
  clear(panel);
  return EXIT_SUCCESS;
}

//--- Wrong states -----------------------------------------------------------

/// Each wrong input has its sentence, and keeps Apply from being pressed.
int checkSentences(const Panel& panel)
{
  std::set<std::string> sentences;
  const auto isRefused = [&] { return !panel.applyButton()->isEnabled() && sentences.insert(panel.problem()).second; };
  CHECK_BOOL(isRefused(), true); // nothing there
  vtkMRMLSegmentationNode* empty = addEmptySegmentation(panel.host.scene());
  panel.host.waitFor(0.1);
  CHECK_BOOL(isRefused(), true); // there, and not chosen
  panel.choose("TissueMapSelector", empty);
  CHECK_BOOL(isRefused(), true);
  const Inputs inputs = fill(panel);
  CHECK_BOOL(panel.applyButton()->isEnabled(), true);
  panel.choose("TargetsSelector", nullptr);
  panel.choose("PathSelector", nullptr);
  CHECK_BOOL(isRefused(), true);
  panel.choose("PathSelector", inputs.path);
  CHECK_BOOL(panel.applyButton()->isEnabled(), true);
  panel.spin("NullDisplacementRadiusSpinBox", 5);
  CHECK_BOOL(isRefused(), true);
  panel.fix();
  CHECK_BOOL(panel.applyButton()->isEnabled(), true);
  panel.node()->SetCombine("targets");
  CHECK_BOOL(isRefused(), true);
  panel.fix();
  inputs.path->RemoveNthControlPoint(1);
  CHECK_BOOL(isRefused(), true);
  panel.choose("PathSelector", nullptr);
  panel.choose("TargetsSelector", inputs.targets);
  panel.slide("MinimumEdgeLengthSlider", 5);
  CHECK_BOOL(isRefused(), true);
  panel.fix();
  CHECK_DOUBLE(panel.node()->GetMinimumEdgeLength(), 3);
  panel.node()->SetTissueLengths("/no/such/file.csv");
  CHECK_BOOL(isRefused(), true);
  panel.fix();
  CHECK_BOOL(panel.applyButton()->isEnabled(), true);
  // The grid of a segmentation is looked at when it is needed.
  vtkMRMLTransformNode* turn = addTransform(panel.host.scene());
  vtkMRMLSegmentationNode* turned = addSegmentation(panel.host.scene(), inputs.labelMap);
  turned->SetAndObserveTransformNodeID(turn->GetID());
  turned->HardenTransform();
  vtkMRMLTransformNode* stretch = addTransform(panel.host.scene());
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 0, 2);
  stretch->SetMatrixTransformToParent(matrix);
  turned->SetAndObserveTransformNodeID(stretch->GetID());
  panel.choose("TissueMapSelector", turned);
  panel.applyButton()->click();
  CHECK_BOOL(isRefused(), true);
  CHECK_BOOL(panel.run->IsBusy(), false);
  panel.choose("TissueMapSelector", inputs.labelMap);
  panel.spin("NullDisplacementRadiusSpinBox", 5);
  panel.node()->SetNullDisplacementTissues("no such tissue");
  CHECK_BOOL(isRefused(), true);
  panel.node()->SetNullDisplacementTissues("tumour, 2");
  CHECK_BOOL(panel.applyButton()->isEnabled(), true);
  clear(panel);
  CHECK_DOUBLE(panel.node()->GetMinimumEdgeLength(), 1); // the panel starts anew
  CHECK_DOUBLE(panel.child<ctkSliderWidget>("MinimumEdgeLengthSlider")->value(), 1);
  return EXIT_SUCCESS;
}

int checkCancel(const Panel& panel)
{
  fill(panel);
  makeSlow(panel);
  const LeftoverCheck nodes(panel.host.scene());
  for (const double delay : { 0.0, 0.05, 0.15, 0.25, 0.4, 0.7 })
  {
    panel.applyButton()->click();
    panel.host.waitFor(delay);
    if (!panel.run->IsBusy()) continue; // too late
    panel.cancelButton()->click();
    CHECK_BOOL(panel.waitForEnd(), true);
    CHECK_BOOL(panel.run->GetStatus() == Run::Cancelled || panel.run->GetStatus() == Run::Completed, true);
    if (panel.run->GetStatus() == Run::Completed) continue; // its results were being read
    CHECK_STD_STRING(nodes.leftovers(), "");
    CHECK_NULL(panel.node()->GetScalarVolumeNode(Node::ScaleRole()));
    CHECK_BOOL(panel.applyButton()->isEnabled(), true);
    CHECK_STD_STRING(panel.sentence(), "Cancelled.");
  }
  CHECK_INT(panel.run->GetStatus(), Run::Cancelled);
  clear(panel);
  return EXIT_SUCCESS;
}

int checkSecondApply(const Panel& panel)
{
  fill(panel);
  makeSlow(panel);
  panel.applyButton()->click();
  const LeftoverCheck nodes(panel.host.scene());
  panel.applyButton()->click();
  panel.child<qSurgicalMesherRunWidget>("RunWidget")->apply();
  CHECK_BOOL(panel.logic->Start(panel.node()), false);
  CHECK_STD_STRING(nodes.leftovers(), "");
  CHECK_BOOL(panel.waitForProcess(), true);
  CHECK_BOOL(panel.logic->Start(panel.node()), false);
  panel.cancelButton()->click();
  CHECK_BOOL(panel.waitForEnd(), true);
  clear(panel);
  return EXIT_SUCCESS;
}

int checkDeletions(const Panel& panel)
{
  const auto startSlowRun = [&]
  {
    const Inputs inputs = fill(panel);
    makeSlow(panel);
    panel.applyButton()->click();
    return inputs;
  };
  Inputs inputs = startSlowRun();
  CHECK_BOOL(panel.waitForProcess(), true);
  CHECK_BOOL(panel.run->IsBusy(), true);
  for (vtkMRMLNode* node : { static_cast<vtkMRMLNode*>(inputs.labelMap), static_cast<vtkMRMLNode*>(inputs.targets) })
    panel.host.scene()->RemoveNode(node); // the run has its own copies
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  CHECK_BOOL(panel.problem().empty(), false);
  vtkMRMLNode* scale = panel.node()->GetScalarVolumeNode(Node::ScaleRole());
  CHECK_NOT_NULL(scale);

  startSlowRun();
  CHECK_BOOL(panel.waitForProcess(), true);
  panel.host.scene()->RemoveNode(scale); // where the result was to go
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  CHECK_NOT_NULL(panel.node()->GetScalarVolumeNode(Node::ScaleRole()));
  clear(panel);

  // What the run itself cannot do without: its own copies.
  for (const double delay : { 0.0, 0.15, 0.3, 0.7 })
  {
    startSlowRun();
    panel.host.waitFor(delay);
    CHECK_BOOL(panel.run->IsBusy(), true);
    panel.host.scene()->RemoveNode(panel.run->GetCommandLineNode());
    CHECK_BOOL(panel.run->IsBusy(), false);
    CHECK_INT(panel.run->GetStatus(), Run::Cancelled);
    panel.host.waitFor(0.5);
    clear(panel);
  }
  return EXIT_SUCCESS;
}

int checkSceneClosed(const Panel& panel)
{
  const std::set<std::string> files = temporaryFiles();
  for (const double delay : { 0.0, 0.15, 0.3, 0.7, 1.2 })
  {
    fill(panel);
    panel.child<QCheckBox>("PreviewCheckBox")->setChecked(true);
    CHECK_BOOL(panel.host.waitUntil([&] { return panel.logic->IsPreviewShown(); }), true);
    makeSlow(panel);
    panel.applyButton()->click();
    panel.host.waitFor(delay);
    panel.host.scene()->Clear(0);
    CHECK_BOOL(panel.run->IsBusy(), false);
    CHECK_BOOL(panel.logic->IsPreviewShown(), false);
    panel.host.waitFor(0.6);
    CHECK_NULL(panel.host.scene()->GetFirstNodeByClass("vtkMRMLCommandLineModuleNode"));
    CHECK_NULL(panel.host.scene()->GetFirstNodeByClass("vtkMRMLScalarVolumeNode"));
    CHECK_BOOL(panel.applyButton()->isEnabled(), false);
    CHECK_BOOL(panel.problem().empty(), false);
  }
  CHECK_BOOL(temporaryFiles() == files, true);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerSurgicalPathScaleModuleWidgetTest(int, char*[])
{
  HostApplication host;
  const Panel panel(host);
  for (const auto check : { checkSentences, checkApply, checkSegmentation, checkPreview, checkPlotAndEstimate,
                            checkPlacing, checkCancel, checkSecondApply, checkDeletions, checkSceneClosed })
  {
    CHECK_EXIT_SUCCESS(check(panel));
    CHECK_STD_STRING(host.complaints(), "");
  }
  return EXIT_SUCCESS;
}
