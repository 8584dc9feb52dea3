// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs the command-line modules of Tissue Mapper for a parameter node, and makes their results legible.

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

  /// The scene's first parameter node, made if there is none; null without a scene.
  vtkMRMLTissueMapperNode* ParameterNode();

  enum Task
  {
    Classify,         ///< the parameter node's label map from its images and training points
    FindCompartments, ///< where the classes may be, in coarse voxels, as a label map
    Register,         ///< the moving image onto the fixed one
    TraceTube,        ///< the curve along a tube from its points
    AddTube           ///< the same, and the tube becomes a tissue of the label map
  };

  surgicalmesher::TaskCheck FindProblem(Task task, vtkMRMLTissueMapperNode* parameters);
  /// Starts a run. The nodes chosen for results keep their contents until it completes; those that are not chosen are
  /// made then. Returns what kept it from starting; a run that is busy goes on, and nothing is said.
  surgicalmesher::TaskCheck Start(Task task, vtkMRMLTissueMapperNode* parameters);
  /// The one run of a task. By the time that others see its CompletedEvent, if they observe it with the default
  /// priority, the results have been finished.
  vtkSurgicalMesherRun* GetRun(Task task) const;

  /// Puts a label map, tissues or compartments, half transparent over every slice view; null for none.
  void ShowLabelMap(vtkMRMLNode* labelMap);
  /// Puts the registered image half transparent over the fixed one in every slice view.
  void ShowRegistered(vtkMRMLTissueMapperNode* parameters);

  /// Of the classification that completed last: the classes that no voxel is of.
  std::vector<std::string> GetEmptyClasses() const;
  /// Of the registration that completed last.
  const surgicalmesher::FoundRegistration& GetFoundRegistration() const;
  /// Of the tube that a task has followed last.
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
