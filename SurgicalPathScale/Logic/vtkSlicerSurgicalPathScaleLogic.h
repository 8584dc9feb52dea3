// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs SurgicalPathScaleCLI for a parameter node and names and colours its results; computes preview and estimate
/// within Slicer's process.

#include "TissueMapInput.h"
#include "vtkSlicerSurgicalPathScaleModuleLogicExport.h"

#include <vtkSlicerModuleLogic.h>

#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <memory>
#include <string>

class vtkCallbackCommand;
class vtkMRMLLabelMapVolumeNode;
class vtkMRMLScalarVolumeNode;
class vtkMRMLSurgicalPathScaleNode;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{
class ScalePreview;
}

class VTK_SLICER_SURGICALPATHSCALE_MODULE_LOGIC_EXPORT vtkSlicerSurgicalPathScaleLogic : public vtkSlicerModuleLogic
{
public:
  static vtkSlicerSurgicalPathScaleLogic* New();
  vtkTypeMacro(vtkSlicerSurgicalPathScaleLogic, vtkSlicerModuleLogic);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Returns the first parameter node of the scene, created if there is none; null without a scene.
  vtkMRMLSurgicalPathScaleNode* ParameterNode();

  /// Reasons why a parameter node cannot be run.
  enum class Problem
  {
    None,
    NoModule,               ///< SurgicalPathScaleCLI is not loaded
    TissueMap,              ///< see Check::tissueMap
    NoFocus,                ///< no target is placed, and no path of two points or more
    PathOfOnePoint,         ///< the path `name` has only one point
    NoTarget,               ///< only targets are to be used, and there is none
    NoPath,                 ///< only paths are to be used, and there is none
    LengthsContradict,      ///< the minimum is above the maximum
    NoTissueLengths,        ///< the file `name` does not exist
    NullDisplacementTarget, ///< a radius around targets is given, but no target
    NullDisplacementPath,   ///< a distance from paths is given, but no path
    /// Refused by the core with the message `name`: a table that does not fit, an unknown tissue.
    Refused
  };
  struct Check
  {
    Problem problem = Problem::None;
    surgicalmesher::TissueMapProblem tissueMap = surgicalmesher::TissueMapProblem::None;
    std::string name;
  };
  Check FindProblem(vtkMRMLSurgicalPathScaleNode* parameters);

  /// Starts a run, unless there is a problem or a run is busy. Output nodes keep their contents until the run
  /// completes; wanted outputs without a node are created then. Returns false if the run could not be started;
  /// GetStartProblem() has the reason.
  bool Start(vtkMRMLSurgicalPathScaleNode* parameters);
  /// The same, but waits in this thread for the end of the run.
  bool StartAndWait(vtkMRMLSurgicalPathScaleNode* parameters);

  /// Why the last Start failed; it checks more than FindProblem does.
  const Check& GetStartProblem() const { return this->StartProblem; }

  /// The only run of this logic. Observers of its CompletedEvent with the default priority see finished results.
  vtkSurgicalMesherRun* GetRun() const { return this->Run; }

  /// Shows the scale volume of the parameter node in the slice views, replacing the preview.
  void ShowResult(vtkMRMLSurgicalPathScaleNode* parameters);

  /// Expected numbers of elements; negative if unknown.
  struct Estimate
  {
    double triangles = -1;
    double tetrahedra = -1;
  };
  /// Estimate returned by the last completed run.
  Estimate GetEstimateOfRun() const;
  /// Estimate for the current parameters; unknown while there is a problem.
  Estimate EstimateMesh(vtkMRMLSurgicalPathScaleNode* parameters);

  /// Shows edge lengths and, if wanted, null displacement over the slice views, or updates them. While there is a
  /// problem, returns false and shows nothing.
  bool ShowPreview(vtkMRMLSurgicalPathScaleNode* parameters);
  void HidePreview();
  bool IsPreviewShown() const;
  /// Frees the voxels that preview and estimate keep between changes.
  void ReleaseTissueMap();
  /// Hidden nodes; null while the preview is not shown.
  vtkMRMLScalarVolumeNode* GetPreviewScaleNode() const;
  vtkMRMLLabelMapVolumeNode* GetPreviewNullDisplacementNode() const;

protected:
  vtkSlicerSurgicalPathScaleLogic();
  ~vtkSlicerSurgicalPathScaleLogic() override;
  vtkSlicerSurgicalPathScaleLogic(const vtkSlicerSurgicalPathScaleLogic&) = delete;
  void operator=(const vtkSlicerSurgicalPathScaleLogic&) = delete;

  void RegisterNodes() override;
  void SetMRMLSceneInternal(vtkMRMLScene* scene) override;
  void OnMRMLSceneStartClose() override;

private:
  bool Prepare(vtkMRMLSurgicalPathScaleNode* parameters);
  void PrepareFocus(vtkMRMLSurgicalPathScaleNode* parameters);
  bool HasStarted(bool isStarted);
  void PrepareOutputs(vtkMRMLSurgicalPathScaleNode* parameters);
  void FinishRun();
  void FinishScale(vtkMRMLSurgicalPathScaleNode* parameters);
  void FinishLabelMap(vtkMRMLSurgicalPathScaleNode* parameters);

  Check StartProblem;
  vtkNew<vtkSurgicalMesherRun> Run;
  vtkNew<vtkCallbackCommand> RunEnded;
  vtkWeakPointer<vtkMRMLSurgicalPathScaleNode> Parameters; ///< of the current run
  // Slicer empties a volume before it reads a file into it, which causes errors in slice views that show it. Results
  // are therefore read into hidden volumes.
  vtkSmartPointer<vtkMRMLScalarVolumeNode> ScaleResult;
  vtkSmartPointer<vtkMRMLLabelMapVolumeNode> LabelMapResult; ///< null if not wanted
  std::unique_ptr<surgicalmesher::ScalePreview> Preview;
};
