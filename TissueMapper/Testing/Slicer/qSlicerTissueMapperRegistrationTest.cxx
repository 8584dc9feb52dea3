// SPDX-License-Identifier: Apache-2.0
// Registration in the panel: one image onto another, and the sentence where that can't be.

#include "HostScene.h"
#include "MeshComparison.h"
#include "Panel.h"
#include "RegistrationPhantom.h"
#include "TissueMapIO.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLSliceCompositeNode.h>

#include <QDoubleSpinBox>

#include <cmath>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Node = vtkMRMLTissueMapperNode;
using Run = vtkSurgicalMesherRun;
using Logic = vtkSlicerTissueMapperLogic;

namespace
{

struct Inputs
{
  ScalarImage ct = registrationPhantom(LinearMap(), ctBrightness);
  ScalarImage mr = registrationPhantom(poseOff(), mrBrightness);
  vtkMRMLScalarVolumeNode* fixed = nullptr;
  vtkMRMLScalarVolumeNode* moving = nullptr;
};

Inputs fill(const Panel& panel)
{
  Inputs inputs;
  inputs.fixed = addVolume(panel.host.scene(), "CT", inputs.ct);
  inputs.moving = addVolume(panel.host.scene(), "MR", inputs.mr);
  panel.choose("FixedImageSelector", inputs.fixed);
  panel.choose("MovingImageSelector", inputs.moving);
  return inputs;
}

void clear(const Panel& panel)
{
  panel.host.scene()->Clear(0);
  panel.host.waitFor(0.1);
}

const float* voxelsOf(vtkMRMLNode* volume)
{
  vtkImageData* image = vtkMRMLScalarVolumeNode::SafeDownCast(volume)->GetImageData();
  return image->GetScalarType() == VTK_FLOAT ? static_cast<const float*>(image->GetScalarPointer()) : nullptr;
}

/// What the command line makes of the same images, on the fixed one's grid and over it in the views.
int checkApply(const Panel& panel)
{
  const Inputs inputs = fill(panel);
  auto* target = addMarkups(panel.host.scene(), "vtkMRMLMarkupsFiducialNode", {});
  target->AddControlPoint(-phantomTarget.x, -phantomTarget.y, phantomTarget.z);
  CHECK_BOOL(panel.child<QDoubleSpinBox>("TargetRadiusSpinBox")->isEnabled(), false);
  panel.choose("TargetSelector", target);
  panel.child<QDoubleSpinBox>("TargetRadiusSpinBox")->setValue(45);
  const std::string folder = newFolder("TissueMapperRegistration");
  writeImage(inputs.ct, folder + "/ct.nrrd");
  writeImage(inputs.mr, folder + "/mr.nrrd");
  runCommandLine("LocalRegistrationCLI",
                 { "--sphere", "8,-35,-30,45", folder + "/ct.nrrd", folder + "/mr.nrrd", folder + "/registered.nrrd" });
  const ScalarImage expected = readImage(folder + "/registered.nrrd");

  const LeftoverCheck nodes(panel.host.scene());
  const std::set<std::string> files = temporaryFiles();
  CHECK_STD_STRING(panel.problem(), "");
  panel.apply();
  CHECK_BOOL(panel.run->IsBusy(), true);
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_STD_STRING(panel.run->GetErrorText(), "");
  CHECK_INT(panel.run->GetStatus(), Run::Completed);
  vtkMRMLNode* registered = panel.node()->GetNodeReference(Node::RegisteredImageRole());
  CHECK_NOT_NULL(registered);
  CHECK_STRING(registered->GetName(), "MR registered");
  const float* found = voxelsOf(registered);
  CHECK_NOT_NULL(found);
  double worst = 0;
  for (std::size_t n = 0; n < expected.values.size(); ++n)
    worst = std::max(worst, double(std::abs(found[n] - expected.values[n])));
  CHECK_BOOL(worst < 1, true); // of some 100; the frame goes through the host's own files
  CHECK_BOOL(panel.logic->GetFoundRegistration().agreeingStarts >= 4, true);
  CHECK_BOOL(panel.sentence().find("Registered in") == 0, true);
  auto* view =
    vtkMRMLSliceCompositeNode::SafeDownCast(panel.host.scene()->GetFirstNodeByClass("vtkMRMLSliceCompositeNode"));
  CHECK_STRING(view->GetForegroundVolumeID(), registered->GetID());
  CHECK_STRING(view->GetBackgroundVolumeID(), inputs.fixed->GetID());
  CHECK_STD_STRING(nodes.leftovers({ "vtkMRMLScalarVolumeNode", "vtkMRMLScalarVolumeDisplayNode" }), "");
  CHECK_BOOL(temporaryFiles() == files, true);
  clear(panel);
  return EXIT_SUCCESS;
}

int checkSentences(const Panel& panel)
{
  std::set<std::string> sentences;
  const auto isRefused = [&]
  { return !panel.button("ApplyButton")->isEnabled() && sentences.insert(panel.problem()).second; };
  CHECK_BOOL(isRefused(), true); // nothing there
  const Inputs inputs = fill(panel);
  panel.host.waitFor(0.1);
  CHECK_STD_STRING(panel.problem(), "");
  panel.choose("FixedImageSelector", nullptr);
  CHECK_BOOL(isRefused(), true);
  panel.choose("FixedImageSelector", inputs.fixed);
  panel.choose("MovingImageSelector", nullptr);
  CHECK_BOOL(isRefused(), true);
  panel.choose("MovingImageSelector", inputs.fixed);
  CHECK_BOOL(isRefused(), true);

  // What only the module finds out is told in its words, and no volume is made.
  ScalarImage flat = inputs.mr;
  std::fill(flat.values.begin(), flat.values.end(), 5.f);
  panel.choose("MovingImageSelector", addVolume(panel.host.scene(), "Flat", flat));
  CHECK_STD_STRING(panel.problem(), "");
  panel.apply();
  CHECK_BOOL(panel.waitForEnd(), true);
  CHECK_INT(panel.run->GetStatus(), Run::Failed);
  CHECK_BOOL(panel.sentence().find("the moving image has one value nearly everywhere") != std::string::npos, true);
  CHECK_NULL(panel.node()->GetNodeReference(Node::RegisteredImageRole()));
  panel.host.complaints(); // the host's own, on the module's status
  clear(panel);
  return EXIT_SUCCESS;
}

int checkCancel(const Panel& panel)
{
  fill(panel);
  const LeftoverCheck nodes(panel.host.scene());
  for (const double delay : { 0.0, 0.5 })
  {
    panel.apply();
    panel.host.waitFor(delay);
    panel.button("CancelButton")->click();
    CHECK_BOOL(panel.waitForEnd(), true);
    CHECK_INT(panel.run->GetStatus(), Run::Cancelled);
    CHECK_STD_STRING(nodes.leftovers(), "");
    CHECK_NULL(panel.node()->GetNodeReference(Node::RegisteredImageRole()));
  }
  clear(panel);
  return EXIT_SUCCESS;
}

} // namespace

int qSlicerTissueMapperRegistrationTest(int, char*[])
{
  HostApplication host;
  Panel panel{ host };
  panel.footName = "RegistrationRunWidget";
  panel.run = panel.logic->GetRun(Logic::Register);
  for (const auto check : { checkSentences, checkApply, checkCancel })
  {
    CHECK_EXIT_SUCCESS(check(panel));
    CHECK_STD_STRING(host.complaints(), "");
  }
  return EXIT_SUCCESS;
}
