// SPDX-License-Identifier: Apache-2.0
// Balloons in the panel: what is missing, growth that is seen, the results in the scene, and a run that is cancelled.

#include "Panel.h"
#include "qSlicerSimplexMesherBalloonSection.h"

#include <ctkCheckableComboBox.h>

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <QDoubleSpinBox>
#include <QRadioButton>

#include <cmath>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLSimplexMesherNode;

namespace
{

constexpr double hollow = 14; // mm, radius within the wall

/// A wall of bone, 1, around a ball that is open towards +z; all else is background.
vtkMRMLLabelMapVolumeNode* addHollow(vtkMRMLScene* scene)
{
  return addLabelMap(scene, "Hollow", 40, 1,
                     [](const Point& p)
                     {
                       const double r = std::hypot(p[0], p[1], p[2]);
                       const bool isHole = p[2] > 0 && std::hypot(p[0], p[1]) <= 3;
                       return r > hollow && r <= hollow + 3 && !isHole ? 1 : 0;
                     });
}

struct Balloons
{
  Panel& panel;
  qSlicerSimplexMesherBalloonSection* section = panel.child<qSlicerSimplexMesherBalloonSection>("BalloonSection");
  BalloonRun& balloons = panel.logic->GetBalloons();
  vtkSurgicalMesherRun* run = balloons.run();

  std::string problem() const
  {
    return findChild<qSurgicalMesherRunWidget>(section, "BalloonRunWidget")->problem().toStdString();
  }
  void press(const char* button) const { findChild<QPushButton>(section, button)->click(); }
  void check(int row) const
  {
    auto* box = findChild<ctkCheckableComboBox>(section, "StopsComboBox");
    box->setCheckState(box->model()->index(row, 0), Qt::Checked);
  }
  bool waitForEnd() const
  {
    return panel.host.waitUntil([this] { return !run->IsBusy(); });
  }
};

int testProblems(Balloons& b)
{
  CHECK_BOOL(b.problem().empty(), false); // no map
  b.panel.choose("TissueMapSelector", addHollow(b.panel.host.scene()));
  b.panel.child<QRadioButton>("EdgeLengthRadioButton")->setChecked(true);
  CHECK_BOOL(b.problem().find("list of points") != std::string::npos, true);
  vtkMRMLMarkupsNode* seeds = addMarkups(b.panel.host.scene(), "vtkMRMLMarkupsFiducialNode", { { 3, -2, 1 } });
  seeds->SetNthControlPointLabel(0, "cavity");
  b.panel.choose("SeedsSelector", seeds);
  CHECK_BOOL(b.problem().find("stop") != std::string::npos, true);
  b.check(0);
  CHECK_BOOL(b.panel.node()->GetBalloonStops() == (std::set<std::string>{ "1" }), true);
  CHECK_STD_STRING(b.problem(), "");
  findChild<QDoubleSpinBox>(b.section, "LimitSpinBox")->setValue(25);
  CHECK_DOUBLE(b.panel.node()->GetBalloonLimit(), 25);
  return EXIT_SUCCESS;
}

int testGrowth(Balloons& b)
{
  b.panel.node()->SetEdgeLength(1); // long enough to be seen
  b.press("ApplyButton");
  CHECK_BOOL(b.run->IsBusy(), true);
  CHECK_BOOL(b.panel.problem().empty(), false); // one run at a time
  double size = 0;
  const auto isSeen = [&]
  {
    vtkMRMLModelNode* growth = b.balloons.growth();
    if (growth && growth->GetPolyData() && growth->GetPolyData()->GetNumberOfPoints() > 0)
      size = growth->GetPolyData()->GetLength();
    return size > 0 || !b.run->IsBusy();
  };
  CHECK_BOOL(b.panel.host.waitUntil(isSeen), true);
  CHECK_BOOL(size > 1 && size < 2 * std::sqrt(3.) * (hollow + 2), true);
  CHECK_BOOL(b.waitForEnd(), true);
  CHECK_STD_STRING(b.run->GetErrorText(), "");
  CHECK_INT(b.run->GetStatus(), vtkSurgicalMesherRun::Completed);
  CHECK_NULL(b.balloons.growth());
  CHECK_STD_STRING(b.panel.problem(), "");
  return EXIT_SUCCESS;
}

int testResults(Balloons& b)
{
  vtkMRMLModelNode* surface = b.panel.node()->GetModelNode(Node::BalloonSurfaceRole());
  CHECK_STRING(surface->GetName(), "Hollow balloons");
  double bounds[6];
  surface->GetRASBounds(bounds);
  for (int side = 0; side < 6; ++side) CHECK_DOUBLE_TOLERANCE(bounds[side], (side % 2 ? 1 : -1) * hollow, 1.5);
  vtkMRMLLabelMapVolumeNode* map = b.panel.node()->GetLabelMapNode(Node::BalloonLabelMapRole());
  CHECK_STRING(map->GetName(), "Hollow with balloons");
  CHECK_STRING(map->GetDisplayNode()->GetColorNode()->GetColorName(2), "cavity");
  int inside = 0;
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) inside += int(map->GetImageData()->GetScalarComponentAsDouble(i, j, k, 0)) == 2;
  CHECK_DOUBLE_TOLERANCE(inside / (4 / 3. * 3.14159 * hollow * hollow * hollow), 1, 0.03);
  return EXIT_SUCCESS;
}

/// The same nodes once more, while the slice views show the label map.
int testSecondRun(Balloons& b)
{
  vtkMRMLLabelMapVolumeNode* map = b.panel.node()->GetLabelMapNode(Node::BalloonLabelMapRole());
  vtkImageData* before = map->GetImageData();
  showInSliceViews(map);
  b.panel.node()->SetEdgeLength(3);
  b.press("ApplyButton");
  CHECK_BOOL(b.waitForEnd(), true);
  CHECK_INT(b.run->GetStatus(), vtkSurgicalMesherRun::Completed);
  CHECK_POINTER(b.panel.node()->GetLabelMapNode(Node::BalloonLabelMapRole()), map);
  CHECK_BOOL(map->GetImageData() != before, true);
  CHECK_STD_STRING(b.panel.host.complaints(), "");
  return EXIT_SUCCESS;
}

int testCancel(Balloons& b)
{
  const LeftoverCheck before(b.panel.host.scene());
  const std::set<std::string> files = temporaryFiles();
  b.press("ApplyButton");
  CHECK_BOOL(b.run->IsBusy(), true);
  b.press("CancelButton");
  CHECK_BOOL(b.waitForEnd(), true);
  CHECK_INT(b.run->GetStatus(), vtkSurgicalMesherRun::Cancelled);
  CHECK_STD_STRING(before.leftovers(), "");
  CHECK_BOOL(temporaryFiles() == files, true);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerSimplexMesherBalloonTest(int, char*[])
{
  HostApplication host;
  Panel panel{ host };
  Balloons balloons{ panel };
  CHECK_EXIT_SUCCESS(testProblems(balloons));
  CHECK_EXIT_SUCCESS(testGrowth(balloons));
  CHECK_EXIT_SUCCESS(testResults(balloons));
  CHECK_EXIT_SUCCESS(testSecondRun(balloons));
  CHECK_EXIT_SUCCESS(testCancel(balloons));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}
