// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fits the template of a parameter node, by TemplateFitCLI in a process of its own.

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

/// The reason why a fit cannot be started.
struct FitCheck
{
  enum Problem
  {
    None,
    NoModule,    ///< TemplateFitCLI isn't loaded
    NoTemplate,  ///< no template is chosen
    NoTarget,    ///< no target is chosen
    SameModel,   ///< the model `name` is chosen as both template and target
    NoCells,     ///< the model `name` has no cells
    NoLandmarks, ///< one of the two lists isn't chosen, or is empty
    SameList,    ///< the list `name` is chosen as both landmark lists
    Refused      ///< the input is invalid; `name` is the error message
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
  /// Result of the last completed run; empty if that run had another parameter node, or its scene is closed.
  FitSummary found(vtkMRMLTemplateHexMesherNode* parameters) const;

  /// Returns the first reason why a fit cannot be started; None if it can.
  static FitCheck findProblem(vtkMRMLTemplateHexMesherNode* parameters);
  /// Starts the run; `module` is the logic of the command-line module. Results are delivered before observers of the
  /// run's CompletedEvent with the default priority are called.
  FitCheck start(vtkMRMLAbstractLogic* module, vtkMRMLTemplateHexMesherNode* parameters);

private:
  void prepare(vtkMRMLTemplateHexMesherNode* parameters);
  std::string fileOf(vtkMRMLModelNode* model);
  void prepareCarried(vtkMRMLTemplateHexMesherNode* parameters);
  void prepareLandmarks(vtkMRMLTemplateHexMesherNode* parameters);
  void end();
  void deliver(vtkMRMLTemplateHexMesherNode* parameters);
  void deliverCarried(vtkMRMLTemplateHexMesherNode* parameters);

  /// A carried mesh: the file to which the module writes it, and the name of its model.
  struct Carried
  {
    std::string file, name;
  };

  vtkNew<vtkSurgicalMesherRun> m_Run;
  vtkNew<vtkCallbackCommand> m_Ended;
  vtkWeakPointer<vtkMRMLTemplateHexMesherNode> m_Parameters; ///< parameter node of the current run
  std::string m_Name, m_FittedFile, m_ReportFile;
  std::vector<Carried> m_Carried;
  FitSummary m_Found;
  vtkWeakPointer<vtkMRMLTemplateHexMesherNode> m_FoundFor; ///< parameter node of the run that gave m_Found
};

} // namespace surgicalmesher
