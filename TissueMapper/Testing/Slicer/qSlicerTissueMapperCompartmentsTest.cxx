// SPDX-License-Identifier: Apache-2.0
// Compartments in the panel: over the slices, and anew when a point or an option changes.

#include "HeadPhantom.h"
#include "HostScene.h"
#include "Panel.h"
#include "TissueMapInput.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLSliceCompositeNode.h>

#include <QCheckBox>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLTissueMapperNode;
using Run = vtkSurgicalMesherRun;
using Logic = vtkSlicerTissueMapperLogic;

namespace
{

struct Inputs
{
  HeadPhantom head = headPhantom(3);
  vtkMRMLScalarVolumeNode* image = nullptr;
  vtkMRMLMarkupsNode* training = nullptr;
};

Inputs fill(const Panel& panel)
{
  Inputs inputs;
  inputs.training = addMarkups(panel.host.scene(), "vtkMRMLMarkupsFiducialNode", {});
  for (const TissueClass& tissue : trainingOf(inputs.head.truth, 15))
  {
    for (const Vec3& p : tissue.points)
    {
      const int n = inputs.training->AddControlPoint(-p.x, -p.y, p.z);
      inputs.training->SetNthControlPointLabel(n, tissue.name);
    }
  }
  inputs.image = addVolume(panel.host.scene(), "T1", inputs.head.image);
  panel.choose("ImageSelector", inputs.image);
  panel.choose("TrainingSelector", inputs.training);
  return inputs;
}

vtkMRMLLabelMapVolumeNode* compartmentsOf(const Panel& panel)
{
  return panel.node()->GetLabelMapNode(Node::CompartmentsRole());
}

std::string shownLabelMap(const Panel& panel)
{
  auto* view =
    vtkMRMLSliceCompositeNode::SafeDownCast(panel.host.scene()->GetFirstNodeByClass("vtkMRMLSliceCompositeNode"));
  return view->GetLabelVolumeID() ? view->GetLabelVolumeID() : "";
}

/// Voxels whose centres lie in the compartment that the truth's tissues there belong to.
double shareRight(const TissueMap& found, const TissueMap& truth)
{
  const std::array<Label, 8> compartmentOf{ 0, 2, 2, 2, 3, 3, 3, 1 };
  std::size_t head = 0, right = 0;
  for (int k = 0; k < found.grid.size[2]; ++k)
    for (int j = 0; j < found.grid.size[1]; ++j)
      for (int i = 0; i < found.grid.size[0]; ++i)
      {
        const Vec3 p = truth.grid.worldToGrid(found.grid.gridToWorld(found.grid.position(i, j, k)));
        const std::array<int, 3> v{ int(p.x + 0.5), int(p.y + 0.5), int(p.z + 0.5) };
        if (!truth.grid.contains(v[0], v[1], v[2])) continue;
        const Label expected = compartmentOf[truth.labels[truth.grid.index(v[0], v[1], v[2])]];
        head += expected != 0;
        right += expected != 0 && expected == found.labels[found.grid.index(i, j, k)];
      }
  return double(right) / double(head);
}

int checkFollowing(const Panel& panel)
{
  CHECK_BOOL(panel.problem().empty(), false);
  const Inputs inputs = fill(panel);
  const LeftoverCheck nodes(panel.host.scene());
  const std::set<std::string> files = temporaryFiles();
  CHECK_STD_STRING(panel.problem(), "");
  panel.host.waitFor(0.8);
  CHECK_BOOL(panel.run->IsBusy(), false); // not unasked
  panel.child<QCheckBox>("CompartmentsAtOnceCheckBox")->setChecked(true);
  CHECK_BOOL(panel.host.waitUntil([&] { return compartmentsOf(panel) && !panel.run->IsBusy(); }), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  vtkMRMLLabelMapVolumeNode* compartments = compartmentsOf(panel);
  const TissueMap found = readTissueMap(compartments);
  CHECK_BOOL(found.grid.size[0] <= inputs.head.image.grid.size[0] / 2 + 1, true);
  CHECK_BOOL(shareRight(found, inputs.head.truth) > 0.95, true);
  CHECK_STD_STRING(found.table.at(2).name, "intracranial");
  CHECK_STD_STRING(shownLabelMap(panel), compartments->GetID());
  CHECK_BOOL(panel.sentence().find("Found in") == 0, true);
  CHECK_STD_STRING(
    nodes.leftovers({ "vtkMRMLLabelMapVolumeNode", "vtkMRMLLabelMapVolumeDisplayNode", "vtkMRMLColorTableNode" }), "");

  // Once more when a point is labelled otherwise, and when the image's voxels change; the same volume is filled again.
  const LeftoverCheck second(panel.host.scene());
  const auto isFoundAgain = [&]
  {
    const vtkMTimeType before = compartments->GetImageData()->GetMTime();
    return panel.host.waitUntil([&]
                                { return compartments->GetImageData()->GetMTime() > before && !panel.run->IsBusy(); });
  };
  inputs.training->SetNthControlPointLabel(0, "grey matter");
  CHECK_BOOL(isFoundAgain(), true);
  inputs.image->GetImageData()->Modified(); // as effects that paint in the image do
  CHECK_BOOL(isFoundAgain(), true);
  CHECK_POINTER(compartmentsOf(panel), compartments);
  CHECK_STD_STRING(second.leftovers(), "");
  CHECK_BOOL(temporaryFiles() == files, true);

  auto* tissues = addVolume<vtkMRMLLabelMapVolumeNode>(panel.host.scene(), "Tissues", inputs.head.truth.grid,
                                                       std::vector<short>(inputs.head.truth.labels.size(), 2));
  panel.choose("LabelMapSelector", tissues);
  panel.child<QPushButton>("ShowTissuesButton")->click();
  CHECK_STD_STRING(shownLabelMap(panel), tissues->GetID());
  panel.host.scene()->Clear(0);
  panel.host.waitFor(0.1);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerTissueMapperCompartmentsTest(int, char*[])
{
  HostApplication host;
  Panel panel{ host };
  panel.footName = "CompartmentsRunWidget";
  panel.run = panel.logic->GetRun(Logic::FindCompartments);
  CHECK_EXIT_SUCCESS(checkFollowing(panel));
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}
