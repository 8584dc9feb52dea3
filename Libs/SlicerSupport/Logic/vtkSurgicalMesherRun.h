// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One run of one of the project's command-line modules, by Slicer's own CLI logic, in a process of its own.
///
/// A run is filled, started once, and thrown away (or filled again: SetCommandLineLogic empties it):
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
/// The run owns what it was given: temporary nodes leave the scene and temporary files the disk when it ends, however
/// it ends, and new output nodes leave the scene unless it completes. Closing the scene, or removing a node that the
/// run reads or writes, cancels it; deleting the run itself does too. Inputs should be hidden copies all the same,
/// because the host writes them to files from another thread.
///
/// Everything is called from, and every event comes on, the main thread.

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
    CompletedEvent ///< the run ended, well or not; after the last StatusChangedEvent, outputs loaded, temporaries gone
  };

  /// The logic of the module's CLI, as vtkSlicerModuleLogic::GetModuleLogic returns it; null if the host doesn't have
  /// the module. Parameters, nodes and files of an earlier run are forgotten. Ignored while running.
  void SetCommandLineLogic(vtkMRMLAbstractLogic* logic);

  /// Parameters by the name that the module's XML gives them. Numbers reach the module with all their digits.
  void SetParameter(const std::string& name, const std::string& value);
  void SetParameter(const std::string& name, const char* value);
  void SetParameter(const std::string& name, double value);
  void SetParameter(const std::string& name, int value);
  void SetParameter(const std::string& name, bool value);
  /// For image, geometry and table parameters; the node is in the scene. Input nodes are written to files by the host.
  void SetParameterNode(const std::string& name, vtkMRMLNode* node);

  /// A node that only this run needs. Added to the scene if it isn't in one, hidden from the user and from saved
  /// scenes.
  void AddTemporaryNode(vtkMRMLNode* node);
  /// A node that the run fills. `isNew`: made for this run, and removed again unless it completes.
  void AddOutputNode(vtkMRMLNode* node, bool isNew);
  /// Name of a file that doesn't exist yet, in a folder of this run's own; `extension` with its dot. What the module
  /// wrote there can be read on CompletedEvent; then the folder goes.
  std::string NewTemporaryFile(const std::string& extension);

  /// False, with a sentence in GetErrorText(), if the run is busy, was never filled, or the host lacks the module.
  bool Start();
  /// The same in the calling thread, without an event loop; ends in Completed or Failed. For tests and scripts.
  bool StartAndWait();
  /// Ends the process; the status becomes Cancelled when it is gone. Nothing happens if the run isn't busy.
  void Cancel();

  Status GetStatus() const;
  bool IsBusy() const { return this->GetStatus() == Running; }
  /// Busy, and the process has not begun: the host's thread looks for the nodes in the scene and writes them to files.
  /// Its look-ups are not guarded: the scene should neither gain nor lose a node meanwhile.
  bool IsStarting() const;
  /// Why the run failed: the module's own line on stderr, with the names of nodes for the host's files; empty
  /// otherwise.
  std::string GetErrorText() const;
  /// For an observer of StatusChangedEvent, with a priority over 0, that can say more.
  void SetErrorText(const std::string& text);
  /// Value that the module returned for a simple output parameter; empty before the end, or if there is none.
  std::string GetReturnedValue(const std::string& name) const;
  double GetElapsedSeconds() const;
  /// For the host's progress bar; null before Start().
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
