// SPDX-License-Identifier: Apache-2.0
// Vessels and nerves in the panel: paths that follow their points, and tubes that become tissues.

#include "HostScene.h"
#include "MarkupsInput.h"
#include "MeshComparison.h"
#include "Panel.h"
#include "TissueMapIO.h"
#include "TissueMapInput.h"
#include "TubePhantoms.h"

#include <qSlicerMarkupsPlaceWidget.h>

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsCurveNode.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLTissueMapperNode;
using Run = vtkSurgicalMesherRun;
using Logic = vtkSlicerTissueMapperLogic;

namespace
{

/// A helix of radius 1.5 mm, bright, in an image of 1 mm, and a tissue around it.
struct Inputs
{
  TubeScene tube = helixScene(Placement(), 1.5);
  ScalarImage image;
  vtkMRMLLabelMapVolumeNode* tissues = nullptr;
  vtkMRMLMarkupsNode* points = nullptr;
};

Inputs fill(const Panel& panel)
{
  Inputs inputs;
  inputs.image = drawTubes(gridAround(inputs.tube.tubes, 8), inputs.tube.tubes, 3);
  std::mt19937 random(4);
  addNoise(inputs.image, 0.15, random);
  vtkMRMLScene* scene = panel.host.scene();
  panel.choose("ImageSelector", addVolume(scene, "MRA", inputs.image));
  std::vector<short> labels(inputs.image.values.size(), 0);
  std::fill(labels.begin() + labels.size() / 4, labels.end(), short(2));
  inputs.tissues = addVolume<vtkMRMLLabelMapVolumeNode>(scene, "Tissues", inputs.image.grid, labels);
  inputs.points = addMarkups(scene, "vtkMRMLMarkupsFiducialNode", {});
  panel.choose("TubePointsSelector", inputs.points);
  return inputs;
}

void place(const Inputs& inputs)
{
  for (const Vec3& p : inputs.tube.places) inputs.points->AddControlPoint(-p.x, -p.y, p.z);
}

vtkMRMLMarkupsCurveNode* pathOf(const Panel& panel)
{
  return vtkMRMLMarkupsCurveNode::SafeDownCast(panel.node()->GetNodeReference(Node::TubePathRole()));
}

void clear(const Panel& panel)
{
  panel.host.scene()->Clear(0);
  panel.host.waitFor(0.1);
}

/// The path comes by itself, and again when a point is moved; not while the panel is closed, and not unasked.
int checkFollowing(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  const LeftoverCheck nodes(panel.host.scene());
  const std::set<std::string> files = temporaryFiles();
  place(inputs);
  CHECK_STD_STRING(panel.problem(), "");
  CHECK_BOOL(panel.host.waitUntil([&] { return pathOf(panel) && !panel.run->IsBusy(); }), true);
  vtkMRMLMarkupsCurveNode* path = pathOf(panel);
  CHECK_BOOL(pathError(markupsPoints(path), inputs.tube.truth).largest < 1, true);
  CHECK_BOOL(std::abs(panel.logic->GetFoundTube(Logic::TraceTube).smallestRadius - 1.5) < 0.5, true);
  CHECK_BOOL(panel.sentence().find("mm long") != std::string::npos, true);
  CHECK_STD_STRING(nodes.leftovers({ "vtkMRMLMarkupsCurveNode", "vtkMRMLMarkupsDisplayNode" }), "");

  const double whole = path->GetCurveLengthWorld();
  const LeftoverCheck second(panel.host.scene());
  const Vec3 half = inputs.tube.truth[inputs.tube.truth.size() / 2];
  inputs.points->SetNthControlPointPosition(1, -half.x, -half.y, half.z);
  CHECK_BOOL(panel.host.waitUntil([&] { return path->GetCurveLengthWorld() < 0.6 * whole; }), true);
  CHECK_POINTER(pathOf(panel), path);
  CHECK_BOOL(panel.host.waitUntil([&] { return !panel.run->IsBusy(); }), true);
  CHECK_STD_STRING(second.leftovers(), "");

  panel.child<QCheckBox>("TraceAtOnceCheckBox")->setChecked(false);
  const Vec3 end = inputs.tube.truth.back();
  inputs.points->SetNthControlPointPosition(1, -end.x, -end.y, end.z);
  panel.host.waitFor(0.6);
  CHECK_BOOL(panel.run->IsBusy(), false);
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_BOOL(std::abs(path->GetCurveLengthWorld() - whole) < 0.01, true);
  CHECK_BOOL(temporaryFiles() == files, true);
  clear(panel);
  return EXIT_SUCCESS;
}

/// Options reach the command line, each with a value that isn't its default.
int checkOptions(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  panel.child<QCheckBox>("TraceAtOnceCheckBox")->setChecked(false);
  place(inputs);
  const std::string folder = newFolder("TissueMapperTubeOptions");
  writeImage(inputs.image, folder + "/image.nrrd");
  writeMarkups({ markupsPoints(inputs.points) }, folder + "/points.mrk.json");
  const auto pathByProgram = [&](std::vector<std::string> options)
  {
    const std::string path = folder + "/path.mrk.json";
    options.insert(options.end(), { "--points", folder + "/points.mrk.json", folder + "/image.nrrd", path });
    runCommandLine("TubePathCLI", options);
    return readMarkups(path).front();
  };
  panel.child<QComboBox>("PotentialComboBox")->setCurrentIndex(2);
  panel.child<QDoubleSpinBox>("SnapSpinBox")->setValue(0);
  panel.child<QDoubleSpinBox>("MarginSpinBox")->setValue(10);
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_NOT_NULL(pathOf(panel));
  const Path traced = markupsPoints(pathOf(panel));
  const auto isTraced = [&](const Path& path)
  {
    return path.size() == traced.size() && std::equal(path.begin(), path.end(), traced.begin(),
                                                      [](const Vec3& a, const Vec3& b) { return norm(a - b) < 1e-3; });
  };
  CHECK_BOOL(isTraced(pathByProgram({ "--potential", "intensity", "--snap", "0", "--margin", "10" })), true);
  CHECK_BOOL(isTraced(pathByProgram({})), false);
  clear(panel);
  return EXIT_SUCCESS;
}

/// The tube joins the label map as the command line has it, beside the tissues that were there.
int checkAdding(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  panel.child<QCheckBox>("TraceAtOnceCheckBox")->setChecked(false);
  place(inputs);
  auto* add = panel.child<QPushButton>("AddTubeButton");
  CHECK_BOOL(add->isEnabled(), false);
  panel.choose("LabelMapSelector", inputs.tissues);
  CHECK_BOOL(add->isEnabled(), true);
  const TissueMap before = readTissueMap(inputs.tissues);
  const std::string folder = newFolder("TissueMapperTube");
  writeTissueMap(before, folder + "/before.nrrd");
  writeImage(inputs.image, folder + "/image.nrrd");
  writeMarkups({ markupsPoints(inputs.points) }, folder + "/points.mrk.json");
  runCommandLine("TubePathCLI",
                 { "--points", folder + "/points.mrk.json", "--addTo", folder + "/before.nrrd", "--labelMap",
                   folder + "/after.nrrd", "--label", "3", folder + "/image.nrrd", folder + "/path.mrk.json" });

  panel.node()->SetTubeName("basilar artery");
  add->click();
  vtkSurgicalMesherRun* run = panel.logic->GetRun(Logic::AddTube);
  CHECK_BOOL(run->IsBusy(), true);
  CHECK_BOOL(panel.host.waitUntil([&] { return !run->IsBusy(); }), true);
  CHECK_STD_STRING(run->GetErrorText(), "");
  CHECK_INT(run->GetStatus(), Run::Completed);
  CHECK_POINTER(panel.node()->GetNodeReference(Node::LabelMapRole()), inputs.tissues);
  const TissueMap after = readTissueMap(inputs.tissues);
  CHECK_BOOL(after.labels == readTissueMap(folder + "/after.nrrd").labels, true);
  CHECK_STD_STRING(after.table.at(3).name, "basilar artery");
  CHECK_BOOL(panel.sentence().find("Added") == 0, true);

  // Once more under the same name: it is the same tissue.
  add->click();
  CHECK_BOOL(panel.host.waitUntil([&] { return !run->IsBusy(); }), true);
  CHECK_BOOL(presentLabels(readTissueMap(inputs.tissues)) == std::vector<Label>({ 2, 3 }), true);
  clear(panel);
  return EXIT_SUCCESS;
}

int checkSentences(const Panel& panel)
{
  std::set<std::string> sentences;
  const auto isRefused = [&]
  { return !panel.button("ApplyButton")->isEnabled() && sentences.insert(panel.problem()).second; };
  CHECK_BOOL(isRefused(), true); // no image
  const Inputs inputs = fill(panel);
  panel.child<QCheckBox>("TraceAtOnceCheckBox")->setChecked(false);
  CHECK_BOOL(isRefused(), true); // no points
  panel.fix();
  CHECK_BOOL(panel.child<qSlicerMarkupsPlaceWidget>("TubePlaceWidget")->placeModeEnabled(), true);
  place(inputs);
  CHECK_STD_STRING(panel.problem(), "");
  panel.child<QDoubleSpinBox>("MinimumRadiusSpinBox")->setValue(2);
  CHECK_BOOL(isRefused(), true);
  panel.fix();
  CHECK_STD_STRING(panel.problem(), "");

  // What only the module finds out.
  inputs.points->AddControlPoint(500, 0, 0);
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Failed);
  CHECK_BOOL(panel.sentence().find("The module failed") == 0, true);
  CHECK_NULL(pathOf(panel));
  panel.host.complaints(); // the host's own, on the module's status
  clear(panel);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerTissueMapperTubeTest(int, char*[])
{
  HostApplication host;
  Panel panel{ host };
  panel.footName = "TubeRunWidget";
  panel.run = panel.logic->GetRun(Logic::TraceTube);
  for (const auto check : { checkSentences, checkFollowing, checkOptions, checkAdding })
  {
    CHECK_EXIT_SUCCESS(check(panel));
    CHECK_STD_STRING(host.complaints(), "");
  }
  return EXIT_SUCCESS;
}
