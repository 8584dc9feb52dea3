// SPDX-License-Identifier: Apache-2.0
// Runs of a command-line module in the host: how they end, and what they leave.

#include "vtkSurgicalMesherRun.h"

#include "HostApplication.h"
#include "HostScene.h"
#include "MarkupsInput.h"
#include "TissueMapInput.h"

#include <vtkMRMLAbstractLogic.h>
#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLCommandLineModuleNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>

#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkTestingOutputWindow.h>

#include <algorithm>
#include <chrono>
#include <thread>

using namespace surgicalmesher;
using namespace surgicalmesher::test;
using Run = vtkSurgicalMesherRun;

namespace
{

/// SurgicalPathScaleCLI of two balls, ready to start; returns the volume that it fills.
vtkMRMLScalarVolumeNode* fill(Run* run, HostApplication& host, double spacing = 2)
{
  vtkMRMLScene* scene = host.scene();
  vtkMRMLLabelMapVolumeNode* balls = addNestedBalls(scene);
  run->SetCommandLineLogic(host.logic("SurgicalPathScaleCLI"));
  const TissueMapNodes map = makeTissueMapNodes(balls);
  run->AddTemporaryNode(map.labelMap);
  run->AddTemporaryNode(map.colors);
  run->SetParameterNode("labelMap", map.labelMap);
  const std::string targets = run->NewTemporaryFile(".mrk.json");
  writeMarkups({ { { 0, 0, 0 } } }, targets);
  run->SetParameter("targets", targets);
  run->SetParameter("spacing", spacing);
  auto* scale = vtkMRMLScalarVolumeNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLScalarVolumeNode"));
  run->AddOutputNode(scale, true);
  run->SetParameterNode("scale", scale);
  return scale;
}

constexpr double slow = 0.1; // mm, of spacing

struct Events
{
  Events(Run* run)
  {
    callback->SetClientData(this);
    callback->SetCallback([](vtkObject* caller, unsigned long event, void* self, void*)
                          { static_cast<Events*>(self)->add(Run::SafeDownCast(caller), event); });
    run->AddObserver(vtkCommand::AnyEvent, callback);
  }
  void add(Run* run, unsigned long event)
  {
    if (event == Run::StatusChangedEvent) statuses.push_back(run->GetStatus());
    if (event == Run::CompletedEvent) ++ends;
  }
  std::vector<int> statuses;
  int ends = 0;
  vtkNew<vtkCallbackCommand> callback;
};

int checkWaiting(HostApplication& host)
{
  vtkNew<Run> run;
  CHECK_BOOL(run->Start(), false); // of what?
  CHECK_BOOL(run->GetErrorText().empty(), false);
  vtkMRMLScalarVolumeNode* scale = fill(run, host);
  Events events(run);
  CHECK_BOOL(run->StartAndWait(), true);
  CHECK_INT(run->GetStatus(), Run::Completed);
  CHECK_NOT_NULL(scale->GetImageData());
  CHECK_BOOL((events.statuses == std::vector<int>{ Run::Running, Run::Completed }), true);
  CHECK_INT(events.ends, 1);
  CHECK_BOOL(std::stod(run->GetReturnedValue("estimatedTetrahedra")) > 0, true);
  CHECK_BOOL(run->Start(), false); // its copies of the inputs are gone
  host.scene()->Clear(0);
  return EXIT_SUCCESS;
}

int checkSuccess(HostApplication& host)
{
  const std::set<std::string> files = temporaryFiles();
  vtkNew<Run> run;
  vtkMRMLScalarVolumeNode* scale = fill(run, host);
  vtkMRMLNode* balls = host.scene()->GetFirstNodeByName("NestedBalls");
  Events events(run);
  CHECK_BOOL(run->Start(), true);
  CHECK_BOOL(run->IsBusy(), true);
  CHECK_BOOL(run->Start(), false);
  CHECK_BOOL(host.waitUntil([&] { return !run->IsBusy(); }), true);
  CHECK_INT(run->GetStatus(), Run::Completed);
  CHECK_NOT_NULL(scale->GetImageData());
  CHECK_INT(events.ends, 1);
  CHECK_BOOL(run->GetElapsedSeconds() > 0, true);
  std::vector<vtkMRMLNode*> maps;
  host.scene()->GetNodesByClass("vtkMRMLLabelMapVolumeNode", maps);
  CHECK_BOOL((maps == std::vector<vtkMRMLNode*>{ balls }), true);
  CHECK_NULL(host.scene()->GetFirstNodeByClass("vtkMRMLCommandLineModuleNode"));
  CHECK_BOOL(temporaryFiles() == files, true);
  host.scene()->Clear(0);
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

/// The module's own line is the run's error; the host logs it as well.
int checkFailure(HostApplication& host)
{
  vtkNew<Run> run;
  const LeftoverCheck nodes(host.scene());
  fill(run, host);
  run->SetParameter("minimumEdgeLength", 9.0); // above the maximum
  Events events(run);
  TESTING_OUTPUT_IGNORE_WARNINGS_ERRORS_BEGIN();
  CHECK_BOOL(run->Start(), true);
  CHECK_BOOL(host.waitUntil([&] { return !run->IsBusy(); }), true);
  TESTING_OUTPUT_IGNORE_WARNINGS_ERRORS_END();
  CHECK_INT(run->GetStatus(), Run::Failed);
  const std::string error = run->GetErrorText();
  CHECK_BOOL(error.find("9") != std::string::npos && error.find('\n') == std::string::npos, true);
  CHECK_BOOL((events.statuses == std::vector<int>{ Run::Running, Run::Failed }), true);
  host.complaints();
  host.scene()->RemoveNode(host.scene()->GetFirstNodeByName("NestedBalls"));
  CHECK_STD_STRING(nodes.leftovers({ "vtkMRMLLabelMapVolumeDisplayNode", "vtkMRMLColorTableNode" }), "");
  host.scene()->Clear(0);
  return EXIT_SUCCESS;
}

int checkDeletedWhileRunning(HostApplication& host)
{
  const std::set<std::string> files = temporaryFiles();
  for (const double delay : { 0.0, 0.15, 0.3, 0.8 })
  {
    auto run = vtkSmartPointer<Run>::New();
    vtkMRMLNode* scale = fill(run, host, slow);
    const std::string id = scale->GetID();
    CHECK_BOOL(run->Start(), true);
    host.waitFor(delay);
    CHECK_BOOL(run->IsBusy(), true);
    run = nullptr;
    CHECK_NULL(host.scene()->GetNodeByID(id));
    CHECK_NULL(host.scene()->GetFirstNodeByClass("vtkMRMLCommandLineModuleNode"));
    host.waitFor(0.5);
    host.scene()->Clear(0);
  }
  CHECK_BOOL(temporaryFiles() == files, true);
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

/// The process is done, and the host has yet to read what it wrote.
int checkDeletedWhileResultsWait(HostApplication& host)
{
  auto run = vtkSmartPointer<Run>::New();
  const std::string id = fill(run, host)->GetID();
  CHECK_BOOL(run->Start(), true);
  const auto isCompleting = [&]
  { return run->GetCommandLineNode()->GetStatus() == vtkMRMLCommandLineModuleNode::Completing; };
  for (int n = 0; n < 6000 && !isCompleting(); ++n) // no events: they would let the host read
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK_BOOL(isCompleting(), true);
  run = nullptr;
  CHECK_NULL(host.scene()->GetNodeByID(id));
  host.waitFor(0.5);
  host.scene()->Clear(0);
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

/// An output that is there already stays, cancelled or not.
int checkCancelled(HostApplication& host)
{
  vtkNew<Run> run;
  fill(run, host, slow);
  auto* kept = vtkMRMLScalarVolumeNode::SafeDownCast(host.scene()->AddNewNodeByClass("vtkMRMLScalarVolumeNode"));
  run->AddOutputNode(kept, false);
  run->Cancel(); // nothing to cancel
  CHECK_BOOL(run->Start(), true);
  host.waitFor(0.5);
  run->Cancel();
  run->Cancel();
  CHECK_BOOL(host.waitUntil([&] { return !run->IsBusy(); }), true);
  CHECK_INT(run->GetStatus(), Run::Cancelled);
  CHECK_STD_STRING(run->GetErrorText(), "");
  std::vector<vtkMRMLNode*> volumes;
  host.scene()->GetNodesByClass("vtkMRMLScalarVolumeNode", volumes);
  CHECK_BOOL(std::count(volumes.begin(), volumes.end(), kept) == 1, true);
  CHECK_INT(int(volumes.size()), 2); // with the balls
  fill(run, host);                   // and once more, to the end
  CHECK_BOOL(run->Start(), true);
  CHECK_BOOL(host.waitUntil([&] { return !run->IsBusy(); }), true);
  CHECK_INT(run->GetStatus(), Run::Completed);
  host.scene()->Clear(0);
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

} // namespace

int vtkSurgicalMesherRunTest(int, char*[])
{
  HostApplication host;
  for (const auto check : { checkWaiting, checkSuccess, checkFailure, checkCancelled, checkDeletedWhileRunning,
                            checkDeletedWhileResultsWait })
    CHECK_EXIT_SUCCESS(check(host));
  return EXIT_SUCCESS;
}
