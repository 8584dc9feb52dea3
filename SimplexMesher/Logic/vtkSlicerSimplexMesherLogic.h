// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs SimplexMesherCLI for a parameter node, and presents its results as models, tables and plots.

#include "BalloonRun.h"
#include "TissueMapInput.h"
#include "TissueRows.h"
#include "vtkSlicerSimplexMesherModuleLogicExport.h"

#include <vtkSlicerModuleLogic.h>

#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <string>
#include <utility>
#include <vector>

class vtkCallbackCommand;
class vtkMRMLModelNode;
class vtkMRMLSimplexMesherNode;
class vtkMRMLVolumeNode;
class vtkSurgicalMesherRun;

class VTK_SLICER_SIMPLEXMESHER_MODULE_LOGIC_EXPORT vtkSlicerSimplexMesherLogic : public vtkSlicerModuleLogic
{
public:
  static vtkSlicerSimplexMesherLogic* New();
  vtkTypeMacro(vtkSlicerSimplexMesherLogic, vtkSlicerModuleLogic);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Returns the first parameter node of the scene, created if there is none; null without a scene.
  vtkMRMLSimplexMesherNode* ParameterNode();

  /// Reasons why a parameter node cannot be run.
  enum class Problem
  {
    None,
    NoModule,            ///< SimplexMesherCLI is not loaded
    TissueMap,           ///< see Check::tissueMap
    NoScale,             ///< the scale volume is missing or has no voxels
    ScaleWarped,         ///< the scale volume is under a nonlinear transform
    ScaleTooSmall,       ///< the scale volume does not cover the whole map
    NoEdgeLength,        ///< the uniform edge length is not positive
    ProximityUnfit,      ///< the proximity at the smallest edge length is 0 or above that at the largest
    LabelTaken,          ///< `tissue` has the label chosen for the surroundings
    NothingToMesh,       ///< all tissues are left out
    LengthsContradict,   ///< `tissue` has a minimum above its maximum
    LengthsOfShellDiffer ///< `tissue` is a shell with two different lengths
  };
  struct Check
  {
    Problem problem = Problem::None;
    surgicalmesher::TissueMapProblem tissueMap = surgicalmesher::TissueMapProblem::None;
    surgicalmesher::TissueRow tissue;
  };

  /// `tissues` is the result of surgicalmesher::listTissues for the parameter node's map; if it is empty, only what
  /// balloons also need is checked.
  Check FindProblem(vtkMRMLSimplexMesherNode* parameters, const std::vector<surgicalmesher::TissueRow>& tissues);

  /// Starts a run, unless there is a problem or a run is busy. If no surface node is chosen, one is created, and set in
  /// the parameter node once the run completes. Returns false if the run could not be started: FindProblem() or
  /// GetRun()->GetErrorText() has the reason.
  bool Start(vtkMRMLSimplexMesherNode* parameters);
  /// The same, but waits in this thread for the end of the run.
  bool StartAndWait(vtkMRMLSimplexMesherNode* parameters);

  /// The only run of this logic, with its status, error and end. Observers of its CompletedEvent with the default
  /// priority see finished results.
  vtkSurgicalMesherRun* GetRun() const { return this->Run; }

  /// Returns the object that runs BalloonSurfaceCLI for the same parameter nodes.
  surgicalmesher::BalloonRun& GetBalloons() { return this->Balloons; }

protected:
  vtkSlicerSimplexMesherLogic();
  ~vtkSlicerSimplexMesherLogic() override;
  vtkSlicerSimplexMesherLogic(const vtkSlicerSimplexMesherLogic&) = delete;
  void operator=(const vtkSlicerSimplexMesherLogic&) = delete;

  void RegisterNodes() override;
  void SetMRMLSceneInternal(vtkMRMLScene* scene) override;
  void OnMRMLSceneNodeRemoved(vtkMRMLNode* node) override;

private:
  bool Prepare(vtkMRMLSimplexMesherNode* parameters);
  void PrepareOptions(vtkMRMLSimplexMesherNode* parameters);
  void PrepareOutputs(vtkMRMLSimplexMesherNode* parameters);
  void PrepareVolume(const char* parameter, vtkMRMLVolumeNode* chosen);
  void FinishRun();
  void FinishVolumes();
  void FinishSurface(vtkMRMLModelNode* surface);
  void FinishReport(vtkMRMLModelNode* surface);

  vtkNew<vtkSurgicalMesherRun> Run;
  vtkNew<vtkCallbackCommand> RunEnded;
  vtkWeakPointer<vtkMRMLSimplexMesherNode> Parameters; ///< of the current run
  vtkWeakPointer<vtkMRMLModelNode> Surface;            ///< of the current run
  std::string ReportFile;                              ///< of the current run; empty if not wanted
  surgicalmesher::BalloonRun Balloons{ this };
  /// Volumes to be filled by the run, each with the hidden volume that Slicer reads into.
  std::vector<std::pair<vtkWeakPointer<vtkMRMLVolumeNode>, vtkSmartPointer<vtkMRMLVolumeNode>>> Volumes;
};
