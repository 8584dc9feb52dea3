// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the panel can do, each by a command-line module in a process of its own.

#include <vtkNew.h>
#include <vtkWeakPointer.h>

#include <string>

class vtkCallbackCommand;
class vtkMRMLAbstractLogic;
class vtkMRMLTissueMapperNode;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{

/// What keeps a task from being run.
struct TaskCheck
{
  enum Problem
  {
    None,
    NoModule,    ///< the command-line module `name` isn't loaded
    NoImage,     ///< no image is chosen
    NoVoxels,    ///< the image `name` has none
    UnderWarp,   ///< a transform of the volume `name` isn't linear
    OtherGrid,   ///< the image `name` has other voxels than the first
    NoTraining,  ///< no training point is placed
    NoClassFile, ///< the file `name` cannot be read
    FewPoints,   ///< less than two points on a tube are placed
    RadiiOdd,    ///< the smallest radius is above the largest, or there is one without the other
    NoMoving,    ///< no image to be moved is chosen
    SameImage,   ///< the image `name` is to be moved onto itself
    NoTissues,   ///< no label map that a tube could join
    Refused      ///< the core's own sentence is `name`
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

  virtual TaskCheck findProblem(vtkMRMLTissueMapperNode* parameters) = 0;
  /// `module` is the command-line module's logic. By the time that others see the run's CompletedEvent, if they observe
  /// it with the default priority, its results have been delivered.
  TaskCheck start(vtkMRMLAbstractLogic* module, vtkMRMLTissueMapperNode* parameters);

protected:
  /// Fills the run. Throws an Error if there is no room for its files.
  virtual void prepare(vtkMRMLTissueMapperNode* parameters) = 0;
  /// The run has completed.
  virtual void deliver(vtkMRMLTissueMapperNode* parameters) = 0;
  virtual void forgetResults() = 0;

private:
  void end();

  std::string m_Module;
  vtkNew<vtkSurgicalMesherRun> m_Run;
  vtkNew<vtkCallbackCommand> m_Ended;
  vtkWeakPointer<vtkMRMLTissueMapperNode> m_Parameters; ///< of the run
};

} // namespace surgicalmesher
