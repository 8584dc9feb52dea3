// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs the command-line modules of Tissue Mapper for a parameter node, and displays their results.

#include "FoundRegistration.h"
#include "FoundTube.h"
#include "PanelTask.h"
#include "vtkSlicerTissueMapperModuleLogicExport.h"

#include <vtkSlicerModuleLogic.h>

#include <memory>
#include <string>
#include <vector>

class vtkMRMLTissueMapperNode;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{
class ClassificationTask;
class RegistrationTask;
class TubeTask;
} // namespace surgicalmesher

class VTK_SLICER_TISSUEMAPPER_MODULE_LOGIC_EXPORT vtkSlicerTissueMapperLogic : public vtkSlicerModuleLogic
{
public:
  static vtkSlicerTissueMapperLogic* New();
  vtkTypeMacro(vtkSlicerTissueMapperLogic, vtkSlicerModuleLogic);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Returns the scene's first parameter node; adds one if there is none. Null without a scene.
  vtkMRMLTissueMapperNode* ParameterNode();

  enum Task
  {
    Classify,         ///< finds the label map of the tissues from images and training points
    FindCompartments, ///< finds the compartments, in coarse voxels, as a label map
    Register,         ///< registers the moving image to the fixed one
    TraceTube,        ///< finds the curve along a tube from its points
    AddTube           ///< the same, and adds the tube to the label map as a tissue
  };

  /// Returns the first reason why a task cannot be started; None if it can.
  surgicalmesher::TaskCheck FindProblem(Task task, vtkMRMLTissueMapperNode* parameters);
  /// Starts a run. The nodes chosen for results keep their contents until the run completes; where none is chosen, a
  /// new node is added then. Returns the reason why the run could not be started. Does nothing if a run of the task is
  /// in progress.
  surgicalmesher::TaskCheck Start(Task task, vtkMRMLTissueMapperNode* parameters);
  /// The run of a task; there is one per task. Results are delivered before observers of its CompletedEvent with the
  /// default priority are called.
  vtkSurgicalMesherRun* GetRun(Task task) const;

  /// Shows a label map (tissues or compartments) in every slice view, half transparent; null: none.
  void ShowLabelMap(vtkMRMLNode* labelMap);
  /// Shows the registered image over the fixed one in every slice view, half transparent.
  void ShowRegistered(vtkMRMLTissueMapperNode* parameters);

  /// Classes without any voxel in the last completed classification.
  std::vector<std::string> GetEmptyClasses() const;
  /// Result of the last completed registration.
  const surgicalmesher::FoundRegistration& GetFoundRegistration() const;
  /// Result of the last completed run of TraceTube or AddTube.
  const surgicalmesher::FoundTube& GetFoundTube(Task task) const;

protected:
  vtkSlicerTissueMapperLogic();
  ~vtkSlicerTissueMapperLogic() override;
  vtkSlicerTissueMapperLogic(const vtkSlicerTissueMapperLogic&) = delete;
  void operator=(const vtkSlicerTissueMapperLogic&) = delete;

  void RegisterNodes() override;

private:
  surgicalmesher::PanelTask& TaskOf(Task task) const;

  std::unique_ptr<surgicalmesher::ClassificationTask> Classification;
  std::unique_ptr<surgicalmesher::ClassificationTask> Compartments;
  std::unique_ptr<surgicalmesher::RegistrationTask> Registration;
  std::unique_ptr<surgicalmesher::TubeTask> Tracing;
  std::unique_ptr<surgicalmesher::TubeTask> Adding;
};
