// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The fit of a parameter node's template, by TemplateFitCLI in a process of its own.

#include "FitResults.h"

#include <vtkNew.h>
#include <vtkWeakPointer.h>

#include <string>
#include <vector>

class vtkCallbackCommand;
class vtkMRMLAbstractLogic;
class vtkMRMLModelNode;
class vtkMRMLTemplateHexMesherNode;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{

/// What keeps a fit from being run.
struct FitCheck
{
  enum Problem
  {
    None,
    NoModule,    ///< TemplateFitCLI isn't loaded
    NoTemplate,  ///< no template is chosen
    NoTarget,    ///< no target is chosen
    SameModel,   ///< the model `name` is chosen for both
    NoCells,     ///< the model `name` has none
    NoLandmarks, ///< one of the two lists isn't chosen, or is empty
    SameList,    ///< the list `name` is chosen for both
    Refused      ///< the core's own sentence is `name`
  };
  Problem problem = None;
  std::string name;
};

class FitTask
{
public:
  FitTask();
  ~FitTask();
  FitTask(const FitTask&) = delete;
  FitTask& operator=(const FitTask&) = delete;

  vtkSurgicalMesherRun* run() const { return m_Run; }
  /// Of the run that completed last; nothing if that was of other parameters, or of a scene that is closed.
  FitSummary found(vtkMRMLTemplateHexMesherNode* parameters) const;

  static FitCheck findProblem(vtkMRMLTemplateHexMesherNode* parameters);
  /// `module` is the command-line module's logic. By the time that others see the run's CompletedEvent, if they observe
  /// it with the default priority, its results have been delivered.
  FitCheck start(vtkMRMLAbstractLogic* module, vtkMRMLTemplateHexMesherNode* parameters);

private:
  void prepare(vtkMRMLTemplateHexMesherNode* parameters);
  std::string fileOf(vtkMRMLModelNode* model);
  void prepareCarried(vtkMRMLTemplateHexMesherNode* parameters);
  void prepareLandmarks(vtkMRMLTemplateHexMesherNode* parameters);
  void end();
  void deliver(vtkMRMLTemplateHexMesherNode* parameters);
  void deliverCarried(vtkMRMLTemplateHexMesherNode* parameters);

  /// Where the module writes what goes along, and what it is called.
  struct Carried
  {
    std::string file, name;
  };

  vtkNew<vtkSurgicalMesherRun> m_Run;
  vtkNew<vtkCallbackCommand> m_Ended;
  vtkWeakPointer<vtkMRMLTemplateHexMesherNode> m_Parameters; ///< of the run
  std::string m_Name, m_FittedFile, m_ReportFile;
  std::vector<Carried> m_Carried;
  FitSummary m_Found;
};

} // namespace surgicalmesher
