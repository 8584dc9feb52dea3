// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs SurgicalPathScaleCLI for a parameter node, shows in the host's own process what the parameters mean, and makes
/// its results legible.

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

  /// The scene's first parameter node, made if there is none; null without a scene.
  vtkMRMLSurgicalPathScaleNode* ParameterNode();

  /// What keeps a parameter node from being run.
  enum class Problem
  {
    None,
    NoModule,               ///< SurgicalPathScaleCLI isn't loaded
    TissueMap,              ///< see `tissueMap`
    NoFocus,                ///< no target is placed, and no path of two points or more
    PathOfOnePoint,         ///< `name` has one point
    NoTarget,               ///< only targets are to count, and there is none
    NoPath,                 ///< only paths are to count, and there is none
    LengthsContradict,      ///< the minimum is above the maximum
    NoTissueLengths,        ///< the file `name` cannot be read
    NullDisplacementTarget, ///< a radius from targets is given, and there is no target
    NullDisplacementPath,   ///< a distance from paths is given, and there is no path
    Refused                 ///< the core's own sentence is `name`: a table that doesn't fit, an unknown tissue
  };
  struct Check
  {
    Problem problem = Problem::None;
    surgicalmesher::TissueMapProblem tissueMap = surgicalmesher::TissueMapProblem::None;
    std::string name;
  };
  Check FindProblem(vtkMRMLSurgicalPathScaleNode* parameters);

  /// Starts a run, unless there is a problem or a run is busy. The nodes chosen for results keep their contents until
  /// the run completes; those that are wanted and not chosen are made then. False if it could not be started:
  /// GetStartProblem() has the reason.
  bool Start(vtkMRMLSurgicalPathScaleNode* parameters);
  /// The same, waiting for its end in this thread.
  bool StartAndWait(vtkMRMLSurgicalPathScaleNode* parameters);

  /// What kept the last Start from starting; more is found out then than FindProblem looks for.
  const Check& GetStartProblem() const { return this->StartProblem; }

  /// The one run of this logic. By the time that others see its CompletedEvent, if they observe it with the default
  /// priority, the results have been finished.
  vtkSurgicalMesherRun* GetRun() const { return this->Run; }

  /// Puts the scale volume of the parameter node over the slice views, in the place of the preview.
  void ShowResult(vtkMRMLSurgicalPathScaleNode* parameters);

  /// Numbers of elements to expect; negative if unknown.
  struct Estimate
  {
    double triangles = -1;
    double tetrahedra = -1;
  };
  /// That of the run that completed last.
  Estimate GetEstimateOfRun() const;
  /// That of the parameters as they are; unknown while there is a problem.
  Estimate EstimateMesh(vtkMRMLSurgicalPathScaleNode* parameters);

  /// Shows edge lengths, and null displacement if it is wanted, over the slice views, or brings them up to date. False,
  /// and nothing is shown, while there is a problem.
  bool ShowPreview(vtkMRMLSurgicalPathScaleNode* parameters);
  void HidePreview();
  bool IsPreviewShown() const;
  /// Lets go of the voxels that preview and estimate keep from one change to the next.
  void ReleaseTissueMap();
  /// Hidden nodes; null while the preview isn't shown.
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
  vtkWeakPointer<vtkMRMLSurgicalPathScaleNode> Parameters; ///< of the run
  // The host empties a volume before it reads a file into it, which slice views that show it complain of: it reads into
  // hidden ones.
  vtkSmartPointer<vtkMRMLScalarVolumeNode> ScaleResult;
  vtkSmartPointer<vtkMRMLLabelMapVolumeNode> LabelMapResult; ///< null if it isn't wanted
  std::unique_ptr<surgicalmesher::ScalePreview> Preview;
};
