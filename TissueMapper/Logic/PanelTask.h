// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A task of the panel, run by a command-line module in a process of its own.

#include <vtkNew.h>
#include <vtkWeakPointer.h>

#include <string>

class vtkCallbackCommand;
class vtkMRMLAbstractLogic;
class vtkMRMLTissueMapperNode;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{

/// The reason why a task cannot be started.
struct TaskCheck
{
  enum Problem
  {
    None,
    NoModule,    ///< the command-line module `name` isn't loaded
    NoImage,     ///< no image is chosen
    NoVoxels,    ///< the image `name` has none
    UnderWarp,   ///< a transform of the volume `name` isn't linear
    OtherGrid,   ///< the image `name` has another grid than the first
    NoTraining,  ///< no training point is placed
    NoClassFile, ///< the file `name` cannot be read
    FewPoints,   ///< less than two points on a tube are placed
    RadiiOdd,    ///< the smallest radius is above the largest, or only one of them is given
    NoMoving,    ///< no moving image is chosen
    SameImage,   ///< the image `name` is chosen as both fixed and moving image
    NoTissues,   ///< no label map that a tube could join
    Refused      ///< the input is invalid; `name` is the error message
  };
  Problem problem = None;
  std::string name;
};

class PanelTask
{
public:
  explicit PanelTask(const std::string& module);
  virtual ~PanelTask();
  PanelTask(const PanelTask&) = delete;
  PanelTask& operator=(const PanelTask&) = delete;

  const std::string& module() const { return m_Module; }
  vtkSurgicalMesherRun* run() const { return m_Run; }

  /// Returns the first reason why the task cannot be started; None if it can.
  virtual TaskCheck findProblem(vtkMRMLTissueMapperNode* parameters) = 0;
  /// Starts the run; `module` is the logic of the command-line module. Results are delivered before observers of the
  /// run's CompletedEvent with the default priority are called.
  TaskCheck start(vtkMRMLAbstractLogic* module, vtkMRMLTissueMapperNode* parameters);

protected:
  /// Sets the inputs and outputs of the run. Throws an Error if its temporary files cannot be written.
  virtual void prepare(vtkMRMLTissueMapperNode* parameters) = 0;
  /// Called when the run has completed: puts its results into the scene.
  virtual void deliver(vtkMRMLTissueMapperNode* parameters) = 0;
  /// Called when the run has ended or could not be prepared.
  virtual void forgetResults() = 0;

private:
  void end();

  std::string m_Module;
  vtkNew<vtkSurgicalMesherRun> m_Run;
  vtkNew<vtkCallbackCommand> m_Ended;
  vtkWeakPointer<vtkMRMLTissueMapperNode> m_Parameters; ///< parameter node of the current run
};

} // namespace surgicalmesher
