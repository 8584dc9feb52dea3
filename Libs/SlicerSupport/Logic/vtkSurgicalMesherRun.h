// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A single run of one of the project's command-line modules in a separate process, through Slicer's own CLI logic.
///
/// A run is configured, started once, and discarded (or configured again: SetCommandLineLogic resets it):
///
///     vtkNew<vtkSurgicalMesherRun> run;
///     run->SetCommandLineLogic(logic->GetModuleLogic("SimplexMesherCLI"));
///     run->AddTemporaryNode(labelMap);             // hidden copy, see TissueMapInput.h
///     run->SetParameterNode("labelMap", labelMap);
///     run->SetParameter("edgeLength", 2.0);
///     run->AddOutputNode(model, true);
///     run->SetParameterNode("surface", model);
///     run->Start();                                // later: CompletedEvent, and GetStatus() says how it ended
///
/// The run owns its nodes and files: when it ends, in whatever way, temporary nodes are removed from the scene and
/// temporary files from the disk; new output nodes are removed unless the run completes. Closing the scene or removing
/// a node that the run reads or writes cancels it, as does deleting the run. Inputs should still be hidden copies,
/// because Slicer writes them to files from another thread.
///
/// All functions must be called from the main thread, where all events are invoked.

#include "vtkSurgicalMesherSupportLogicExport.h"

#include <vtkCommand.h>
#include <vtkObject.h>

#include <string>

class vtkMRMLAbstractLogic;
class vtkMRMLCommandLineModuleNode;
class vtkMRMLNode;

class VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkSurgicalMesherRun : public vtkObject
{
public:
  static vtkSurgicalMesherRun* New();
  vtkTypeMacro(vtkSurgicalMesherRun, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Status
  {
    Idle,
    Running, ///< from Start() until the outputs are in the scene
    Completed,
    Cancelled,
    Failed
  };

  enum Events
  {
    StatusChangedEvent = vtkCommand::UserEvent + 1,
    /// The run ended, in whatever way; follows the last StatusChangedEvent; outputs loaded, temporaries removed.
    CompletedEvent
  };

  /// Sets the logic of the module's CLI, as returned by vtkSlicerModuleLogic::GetModuleLogic; null if the module is
  /// missing. Discards parameters, nodes and files of an earlier run. Ignored while running.
  void SetCommandLineLogic(vtkMRMLAbstractLogic* logic);

  /// Sets a parameter by its name in the module's XML. Numbers are passed with full precision.
  void SetParameter(const std::string& name, const std::string& value);
  void SetParameter(const std::string& name, const char* value);
  void SetParameter(const std::string& name, double value);
  void SetParameter(const std::string& name, int value);
  void SetParameter(const std::string& name, bool value);
  /// Sets an image, geometry or table parameter; the node must be in the scene. Slicer writes input nodes to files.
  void SetParameterNode(const std::string& name, vtkMRMLNode* node);

  /// Adds a node that only this run needs. It is added to the scene if necessary, hidden from the user and not saved.
  void AddTemporaryNode(vtkMRMLNode* node);
  /// Adds a node that the run fills. `isNew`: created for this run, and removed unless the run completes.
  void AddOutputNode(vtkMRMLNode* node, bool isNew);
  /// Returns the name of a new, empty file in a folder of this run; `extension` includes its dot. What the module
  /// writes to it can be read on CompletedEvent; then the folder is removed.
  std::string NewTemporaryFile(const std::string& extension);

  /// Starts the run. Returns false, with a message in GetErrorText(), if the run is busy, was not configured or was
  /// started before, or if the module is missing.
  bool Start();
  /// The same in the calling thread, without an event loop; ends as Completed or Failed. For tests and scripts.
  bool StartAndWait();
  /// Ends the process; the status becomes Cancelled once it is gone. Does nothing if the run is not busy.
  void Cancel();

  Status GetStatus() const;
  bool IsBusy() const { return this->GetStatus() == Running; }
  /// Whether the run is busy but the process has not begun: Slicer's thread looks up the nodes in the scene and writes
  /// them to files. These look-ups are not locked, so that no node should be added to or removed from the scene
  /// meanwhile.
  bool IsStarting() const;
  /// Returns why the run failed or could not be started; empty otherwise. For a failed process, this is its last line
  /// on stderr, with node names in place of Slicer's temporary files.
  std::string GetErrorText() const;
  /// Replaces the message; for observers of StatusChangedEvent with a priority above 0 that know more.
  void SetErrorText(const std::string& text);
  /// Returns the value of a simple output parameter of the module; empty before the end, or if there is none.
  std::string GetReturnedValue(const std::string& name) const;
  double GetElapsedSeconds() const;
  /// For Slicer's progress bar; null before SetCommandLineLogic().
  vtkMRMLCommandLineModuleNode* GetCommandLineNode() const;

protected:
  vtkSurgicalMesherRun();
  ~vtkSurgicalMesherRun() override;

private:
  vtkSurgicalMesherRun(const vtkSurgicalMesherRun&) = delete;
  void operator=(const vtkSurgicalMesherRun&) = delete;

  class Internal;
  Internal* const Private;
};
