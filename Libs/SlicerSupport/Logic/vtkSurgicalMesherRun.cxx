// SPDX-License-Identifier: Apache-2.0
#include "vtkSurgicalMesherRun.h"

#include "SceneNodes.h"

#include <ModuleDescription.h>
#include <ModuleProcessInformation.h>
#include <vtkMRMLCommandLineModuleNode.h>
#include <vtkMRMLScene.h>
#include <vtkSlicerApplicationLogic.h>
#include <vtkSlicerCLIModuleLogic.h>
#include <vtkSlicerTask.h>

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>
#include <vtksys/Directory.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <locale>
#include <sstream>
#include <thread>
#include <vector>

#ifdef _WIN32
#include <process.h>
#else
#include <unistd.h>
#endif

namespace
{

using Clock = std::chrono::steady_clock;

int processId()
{
#ifdef _WIN32
  return _getpid();
#else
  return int(getpid());
#endif
}

/// Replaces Slicer's file names of nodes by the names of the nodes. The files are named by node IDs, with letters for
/// digits, which mean nothing to the user.
std::string withNodeNames(std::string text, const std::vector<vtkSmartPointer<vtkMRMLNode>>& nodes,
                          const std::string& folder)
{
  for (vtkMRMLNode* node : nodes)
  {
    std::string stem = std::string("_") + (node->GetID() ? node->GetID() : "") + ".";
    std::transform(stem.begin(), stem.end(), stem.begin(),
                   [](char c) { return c >= '0' && c <= '9' ? char(c - '0' + 'A') : c; });
    for (std::size_t at = text.find(stem); at != text.npos; at = text.find(stem, at + 1))
    {
      const std::size_t begin = text.rfind(folder, at), end = text.find_first_of(".:;, ", at + stem.size());
      if (folder.empty() || begin == text.npos || (end < text.size() && text[end] == '.')) continue; // another file
      text.replace(begin, end - begin, node->GetName() ? node->GetName() : "");
      at = begin;
    }
  }
  return text;
}

/// Removes the unfinished, hidden outputs that a killed module leaves beside the requested ones. They contain the id of
/// Slicer's process, in digits or with letters for digits.
void removeUnfinishedOutputs(const std::string& folder)
{
  const std::string number = std::to_string(processId());
  std::string letters = number;
  for (char& c : letters) c = char(c - '0' + 'A');
  vtksys::Directory directory;
  if (!directory.Load(folder)) return;
  for (unsigned long n = 0; n < directory.GetNumberOfFiles(); ++n)
  {
    const std::string name = directory.GetFile(n);
    const bool isOurs = name.find("." + number + "_") == 0 || name.find("." + letters + "_") == 0;
    if (isOurs && name.find(".partial") != std::string::npos) vtksys::SystemTools::RemoveFile(folder + "/" + name);
  }
}

/// Two tasks in Slicer's processing thread, scheduled before and after the module's own, which signal that the module's
/// task has begun and ended. The status of the CLI node is not reliable for this: it may report the end of the run
/// while the thread is still working, and the thread may overwrite a Cancel.
class TaskFence : public vtkMRMLAbstractLogic
{
public:
  static TaskFence* New();
  vtkTypeMacro(TaskFence, vtkMRMLAbstractLogic);

  std::atomic<bool> Begun{ false };
  std::atomic<bool> Ended{ false };
  vtkSlicerApplicationLogic* ApplicationLogic = nullptr; // outlives its threads

  bool Schedule(void (TaskFence::*function)(void*))
  {
    vtkNew<vtkSlicerTask> task;
    task->SetTypeToProcessing();
    task->SetTaskFunction(this, static_cast<vtkMRMLAbstractLogic::TaskFunctionPointer>(function), nullptr);
    return this->ApplicationLogic->ScheduleTask(task);
  }
  void Begin(void*) { this->Begun = true; }
  void End(void*)
  {
    // No other module of this Slicer runs now: the thread executes one task after the other.
    const char* folder = this->ApplicationLogic->GetTemporaryPath();
    if (folder) removeUnfinishedOutputs(folder);
    this->Ended = true;
    this->ApplicationLogic->RequestModified(this); // invokes Modified() on the main thread
  }
};
vtkStandardNewMacro(TaskFence);

std::string numberText(double value)
{
  std::string text;
  for (int digits : { 15, 17 })
  {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(digits);
    stream << value;
    text = stream.str();
    std::istringstream back(text);
    back.imbue(std::locale::classic());
    double read = 0;
    if (back >> read && read == value) break;
  }
  return text;
}

/// Returns the last line of stderr as kept by Slicer, without its heading and the name of the executable.
std::string moduleErrorLine(const std::string& errorText, const std::string& executable)
{
  const std::string heading = "standard error:\n\n";
  const std::size_t start = errorText.find(heading);
  std::istringstream lines(start == std::string::npos ? errorText : errorText.substr(start + heading.size()));
  std::string last;
  for (std::string line; std::getline(lines, line);)
  {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  const std::string prefix = executable + ": ";
  return last.compare(0, prefix.size(), prefix) == 0 ? last.substr(prefix.size()) : last;
}

/// Creates a new empty folder for the files of one run.
std::string makeFolder(const std::string& parent)
{
  static std::atomic<int> count{ 0 };
  const std::string base = parent.empty() ? std::string(".") : parent;
  std::string folder;
  do {
    folder = base + "/SurgicalMesher-" + std::to_string(processId()) + "-" + std::to_string(++count);
  } while (vtksys::SystemTools::FileExists(folder));
  vtksys::SystemTools::MakeDirectory(folder);
  return folder;
}

void removeFolder(const std::string& folder)
{
  if (!folder.empty()) vtksys::SystemTools::RemoveADirectory(folder);
}

} // namespace

//----------------------------------------------------------------------------
class vtkSurgicalMesherRun::Internal
{
public:
  explicit Internal(vtkSurgicalMesherRun* run) : Run(run)
  {
    this->Callback->SetClientData(this);
    this->Callback->SetCallback(&Internal::OnEvent);
  }

  struct Output
  {
    vtkSmartPointer<vtkMRMLNode> node;
    bool isNew;
  };

  vtkSurgicalMesherRun* Run;
  vtkWeakPointer<vtkSlicerCLIModuleLogic> Logic;
  vtkSmartPointer<vtkMRMLCommandLineModuleNode> CommandLineNode;
  vtkSmartPointer<TaskFence> Fence;
  vtkNew<vtkCallbackCommand> Callback;
  vtkWeakPointer<vtkMRMLScene> Scene;
  vtkWeakPointer<vtkSlicerApplicationLogic> ApplicationLogic;

  std::vector<vtkSmartPointer<vtkMRMLNode>> Temporaries;
  std::vector<Output> Outputs;
  std::vector<vtkSmartPointer<vtkMRMLNode>> Parameters; // nodes set as parameters
  std::string Folder;
  Status CurrentStatus = Idle;
  std::string ErrorText;
  bool IsCancelRequested = false;
  Clock::time_point StartTime;
  double Elapsed = 0;

  void Forget();
  bool Prepare();
  bool ScheduleTasks();
  void Observe();
  void StopObserving();
  void SetStatus(Status status);
  void RequestCancel();
  void AskAgain();
  void EndNow();
  void FinishIfOver();
  void Finish(vtkMRMLNode* leaving = nullptr);
  void CleanUp(Status outcome, vtkMRMLNode* leaving);
  Status Outcome() const;
  bool Uses(vtkMRMLNode* node) const;
  int NodeStatus() const { return this->CommandLineNode->GetStatus(); }

  static void OnEvent(vtkObject* caller, unsigned long event, void* self, void* callData);
};

//----------------------------------------------------------------------------
vtkStandardNewMacro(vtkSurgicalMesherRun);

vtkSurgicalMesherRun::vtkSurgicalMesherRun() : Private(new Internal(this)) {}

vtkSurgicalMesherRun::~vtkSurgicalMesherRun()
{
  Internal& d = *this->Private;
  d.EndNow();
  if (this->IsBusy()) d.CleanUp(Cancelled, nullptr); // no observers are left
  d.Forget();
  delete this->Private;
}

void vtkSurgicalMesherRun::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Status: " << this->GetStatus() << "\n";
  os << indent << "ErrorText: " << this->GetErrorText() << "\n";
}

void vtkSurgicalMesherRun::SetCommandLineLogic(vtkMRMLAbstractLogic* logic)
{
  Internal& d = *this->Private;
  if (this->IsBusy()) return;
  d.Forget();
  d.Logic = vtkSlicerCLIModuleLogic::SafeDownCast(logic);
  d.SetStatus(Idle);
  if (!d.Logic || !d.Logic->GetMRMLScene()) return;
  d.CommandLineNode.TakeReference(d.Logic->CreateNode());
  d.CommandLineNode->SetSaveWithScene(false);
}

void vtkSurgicalMesherRun::SetParameter(const std::string& name, const std::string& value)
{
  Internal& d = *this->Private;
  if (!d.CommandLineNode || this->IsBusy()) return;
  if (!d.CommandLineNode->GetModuleDescription().HasParameter(name))
  {
    vtkErrorMacro("SetParameter: the module has no parameter " << name);
    return;
  }
  d.CommandLineNode->SetParameterAsString(name.c_str(), value);
}

void vtkSurgicalMesherRun::SetParameter(const std::string& name, const char* value)
{
  this->SetParameter(name, std::string(value));
}

void vtkSurgicalMesherRun::SetParameter(const std::string& name, double value)
{
  this->SetParameter(name, numberText(value));
}

void vtkSurgicalMesherRun::SetParameter(const std::string& name, int value)
{
  this->SetParameter(name, std::to_string(value));
}

void vtkSurgicalMesherRun::SetParameter(const std::string& name, bool value)
{
  this->SetParameter(name, std::string(value ? "true" : "false"));
}

void vtkSurgicalMesherRun::SetParameterNode(const std::string& name, vtkMRMLNode* node)
{
  this->SetParameter(name, std::string(node && node->GetID() ? node->GetID() : ""));
  if (node && !this->IsBusy()) this->Private->Parameters.push_back(node);
}

void vtkSurgicalMesherRun::AddTemporaryNode(vtkMRMLNode* node)
{
  Internal& d = *this->Private;
  if (!node || this->IsBusy()) return;
  node->SetHideFromEditors(true);
  node->SetSaveWithScene(false);
  if (!node->GetScene() && d.Logic) d.Logic->GetMRMLScene()->AddNode(node);
  d.Temporaries.push_back(node);
}

void vtkSurgicalMesherRun::AddOutputNode(vtkMRMLNode* node, bool isNew)
{
  if (node && !this->IsBusy()) this->Private->Outputs.push_back({ node, isNew });
}

std::string vtkSurgicalMesherRun::NewTemporaryFile(const std::string& extension)
{
  Internal& d = *this->Private;
  if (d.Folder.empty())
  {
    vtkSlicerApplicationLogic* application = d.Logic ? d.Logic->GetApplicationLogic() : nullptr;
    d.Folder = makeFolder(application ? application->GetTemporaryPath() : ".");
  }
  std::string file;
  int n = 0;
  do {
    file = d.Folder + "/" + std::to_string(++n) + extension;
  } while (vtksys::SystemTools::FileExists(file));
  vtksys::SystemTools::Touch(file, true); // so that the next call returns another name
  return file;
}

bool vtkSurgicalMesherRun::Start()
{
  Internal& d = *this->Private;
  if (!d.Prepare()) return false;
  if (!d.ScheduleTasks())
  {
    d.ErrorText = "Slicer does not take tasks now.";
    d.Finish();
    return false;
  }
  return true;
}

bool vtkSurgicalMesherRun::StartAndWait()
{
  Internal& d = *this->Private;
  if (!d.Prepare()) return false;
  d.Fence->Begun = true;
  d.Logic->ApplyAndWait(d.CommandLineNode, false);
  d.Fence->Ended = true;
  d.Finish();
  return true;
}

void vtkSurgicalMesherRun::Cancel()
{
  if (this->IsBusy()) this->Private->RequestCancel();
}

vtkSurgicalMesherRun::Status vtkSurgicalMesherRun::GetStatus() const { return this->Private->CurrentStatus; }

bool vtkSurgicalMesherRun::IsStarting() const
{
  const Internal& d = *this->Private;
  if (!this->IsBusy() || d.Fence->Ended) return false;
  const int status = d.NodeStatus();
  return status == vtkMRMLCommandLineModuleNode::Scheduled || status == vtkMRMLCommandLineModuleNode::Cancelling;
}

std::string vtkSurgicalMesherRun::GetErrorText() const { return this->Private->ErrorText; }

void vtkSurgicalMesherRun::SetErrorText(const std::string& text) { this->Private->ErrorText = text; }

std::string vtkSurgicalMesherRun::GetReturnedValue(const std::string& name) const
{
  const Internal& d = *this->Private;
  const bool isOver = d.CurrentStatus == Completed || d.CurrentStatus == Failed;
  return isOver && d.CommandLineNode ? d.CommandLineNode->GetParameterAsString(name.c_str()) : std::string();
}

double vtkSurgicalMesherRun::GetElapsedSeconds() const
{
  const Internal& d = *this->Private;
  return d.CurrentStatus == Running ? std::chrono::duration<double>(Clock::now() - d.StartTime).count() : d.Elapsed;
}

vtkMRMLCommandLineModuleNode* vtkSurgicalMesherRun::GetCommandLineNode() const
{
  return this->Private->CommandLineNode;
}

//----------------------------------------------------------------------------
void vtkSurgicalMesherRun::Internal::Forget()
{
  this->StopObserving();
  for (vtkMRMLNode* node : this->Temporaries) surgicalmesher::removeFromScene(node);
  this->Temporaries.clear();
  this->Outputs.clear();
  this->Parameters.clear();
  if (this->CommandLineNode) surgicalmesher::removeFromScene(this->CommandLineNode);
  this->CommandLineNode = nullptr;
  this->Fence = nullptr;
  removeFolder(this->Folder);
  this->Folder.clear();
  this->ErrorText.clear();
  this->Elapsed = 0;
  this->IsCancelRequested = false;
}

/// Does everything except starting the process. A second Start() is refused, since the temporary nodes are gone.
bool vtkSurgicalMesherRun::Internal::Prepare()
{
  if (this->CurrentStatus == Running)
  {
    this->ErrorText = "The module is running already.";
    return false;
  }
  this->ErrorText.clear();
  if (!this->Logic || !this->CommandLineNode || !this->Logic->GetApplicationLogic())
  {
    this->ErrorText = "The command-line module is not installed.";
    return false;
  }
  if (this->CurrentStatus != Idle)
  {
    this->ErrorText = "The run has been started before.";
    return false;
  }
  this->Scene = this->Logic->GetMRMLScene();
  this->ApplicationLogic = this->Logic->GetApplicationLogic();
  this->Scene->AddNode(this->CommandLineNode);
  this->Fence = vtkSmartPointer<TaskFence>::New();
  this->Fence->ApplicationLogic = this->ApplicationLogic;
  this->IsCancelRequested = false;
  this->StartTime = Clock::now();
  this->Observe();
  this->SetStatus(Running);
  return true;
}

bool vtkSurgicalMesherRun::Internal::ScheduleTasks()
{
  if (!this->Fence->Schedule(&TaskFence::Begin)) return false;
  this->Logic->Apply(this->CommandLineNode, false);
  return this->NodeStatus() != vtkMRMLCommandLineModuleNode::Idle && this->Fence->Schedule(&TaskFence::End);
}

void vtkSurgicalMesherRun::Internal::Observe()
{
  this->CommandLineNode->AddObserver(vtkCommand::ModifiedEvent, this->Callback);
  this->Fence->AddObserver(vtkCommand::ModifiedEvent, this->Callback);
  constexpr float beforeOthers = 10; // others may remove nodes that Slicer's thread still accesses
  this->Scene->AddObserver(vtkMRMLScene::StartCloseEvent, this->Callback, beforeOthers);
  this->Scene->AddObserver(vtkMRMLScene::NodeAboutToBeRemovedEvent, this->Callback);
  this->ApplicationLogic->AddObserver(vtkSlicerApplicationLogic::RequestProcessedEvent, this->Callback);
}

void vtkSurgicalMesherRun::Internal::StopObserving()
{
  if (this->CommandLineNode) this->CommandLineNode->RemoveObserver(this->Callback);
  if (this->Fence) this->Fence->RemoveObserver(this->Callback);
  if (this->Scene) this->Scene->RemoveObserver(this->Callback);
  if (this->ApplicationLogic) this->ApplicationLogic->RemoveObserver(this->Callback);
}

void vtkSurgicalMesherRun::Internal::SetStatus(Status status)
{
  if (status == this->CurrentStatus) return;
  this->CurrentStatus = status;
  this->Run->InvokeEvent(vtkSurgicalMesherRun::StatusChangedEvent);
}

/// Once the process has succeeded, its results are being read, and nothing is left to cancel.
void vtkSurgicalMesherRun::Internal::RequestCancel()
{
  if (this->NodeStatus() == vtkMRMLCommandLineModuleNode::Completing) return;
  this->IsCancelRequested = true;
  this->CommandLineNode->Cancel();
}

/// A request to cancel that arrives while Slicer writes the inputs is lost when the process starts: the thread resets
/// first the status and then the flag that it checks.
void vtkSurgicalMesherRun::Internal::AskAgain()
{
  if (this->NodeStatus() == vtkMRMLCommandLineModuleNode::Running) this->CommandLineNode->Cancel();
  if (this->NodeStatus() == vtkMRMLCommandLineModuleNode::Cancelling)
    this->CommandLineNode->GetModuleDescription().GetProcessInformation()->Abort = 1;
}

/// Ends the process and all pending work of Slicer for it immediately. Otherwise, Slicer would dereference null when
/// reading a result into a removed node, and its thread would access removed input nodes.
void vtkSurgicalMesherRun::Internal::EndNow()
{
  if (this->CurrentStatus != Running) return;
  this->StopObserving();
  this->IsCancelRequested = true;
  this->CommandLineNode->Cancel();
  // Enough for a busy machine, but finite so that a broken host does not hang.
  const auto patience = std::chrono::minutes(5);
  const Clock::time_point start = Clock::now();
  while (this->Fence->Begun && !this->Fence->Ended && Clock::now() - start < patience)
  {
    this->AskAgain();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const auto hasResults = [this]
  { return this->ApplicationLogic && this->ApplicationLogic->GetReadDataQueueSize() > 0; };
  // The process may have succeeded before it was cancelled; while results wait, Slicer requires this status.
  if (hasResults() && this->NodeStatus() == vtkMRMLCommandLineModuleNode::Cancelling)
    this->CommandLineNode->SetStatus(vtkMRMLCommandLineModuleNode::Completing, false);
  while (hasResults()) this->ApplicationLogic->ProcessReadData();
}

bool vtkSurgicalMesherRun::Internal::Uses(vtkMRMLNode* node) const
{
  const auto contains = [node](const std::vector<vtkSmartPointer<vtkMRMLNode>>& nodes)
  { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); };
  return node == this->CommandLineNode || contains(this->Temporaries) || contains(this->Parameters) ||
         std::any_of(this->Outputs.begin(), this->Outputs.end(), [node](const Output& o) { return o.node == node; });
}

void vtkSurgicalMesherRun::Internal::OnEvent(vtkObject* caller, unsigned long event, void* self, void* callData)
{
  auto* d = static_cast<Internal*>(self);
  if (d->CurrentStatus != Running) return;
  const vtkSmartPointer<vtkSurgicalMesherRun> keep(d->Run); // an observer may release the run
  if (caller == d->Scene)
  {
    auto* leaving =
      event == vtkMRMLScene::NodeAboutToBeRemovedEvent ? reinterpret_cast<vtkMRMLNode*>(callData) : nullptr;
    if (leaving && !d->Uses(leaving)) return;
    d->EndNow();
    d->Finish(leaving);
    return;
  }
  d->FinishIfOver();
}

void vtkSurgicalMesherRun::Internal::FinishIfOver()
{
  const int status = this->NodeStatus();
  if (this->IsCancelRequested) this->AskAgain();
  const bool isReading =
    status == vtkMRMLCommandLineModuleNode::Completing || this->ApplicationLogic->GetReadDataQueueSize() > 0;
  if (this->Fence->Ended && !isReading) this->Finish();
}

vtkSurgicalMesherRun::Status vtkSurgicalMesherRun::Internal::Outcome() const
{
  if (this->IsCancelRequested) return Cancelled;
  return this->NodeStatus() == vtkMRMLCommandLineModuleNode::Completed ? Completed : Failed;
}

void vtkSurgicalMesherRun::Internal::Finish(vtkMRMLNode* leaving)
{
  this->StopObserving();
  const Status outcome = this->Outcome();
  this->Elapsed = std::chrono::duration<double>(Clock::now() - this->StartTime).count();
  if (outcome == Failed && this->ErrorText.empty())
  {
    const std::string target = this->CommandLineNode->GetModuleTarget();
    this->ErrorText = moduleErrorLine(this->CommandLineNode->GetErrorText(),
                                      vtksys::SystemTools::GetFilenameWithoutLastExtension(target));
    this->ErrorText = withNodeNames(this->ErrorText, this->Parameters, this->ApplicationLogic->GetTemporaryPath());
  }
  this->CleanUp(outcome, leaving);
  std::string folder;
  folder.swap(this->Folder);
  this->SetStatus(outcome);
  this->Run->InvokeEvent(vtkSurgicalMesherRun::CompletedEvent);
  removeFolder(folder);
}

/// `leaving` is a node that is already being removed by the caller.
void vtkSurgicalMesherRun::Internal::CleanUp(Status outcome, vtkMRMLNode* leaving)
{
  std::vector<vtkSmartPointer<vtkMRMLNode>> nodes = this->Temporaries;
  nodes.push_back(this->CommandLineNode);
  for (const Output& output : this->Outputs)
  {
    if (output.isNew && outcome != Completed) nodes.push_back(output.node);
  }
  this->Temporaries.clear();
  this->Parameters.clear();
  this->Outputs.clear();
  for (vtkMRMLNode* node : nodes)
  {
    if (node != leaving) surgicalmesher::removeFromScene(node);
  }
}
