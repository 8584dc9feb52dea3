// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs SimplexMesherCLI for a parameter node, and turns what it leaves into nodes that can be seen, read and plotted.

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

  /// The scene's first parameter node, made if there is none; null without a scene.
  vtkMRMLSimplexMesherNode* ParameterNode();

  /// What keeps a parameter node from being run.
  enum class Problem
  {
    None,
    NoModule,            ///< SimplexMesherCLI isn't loaded
    TissueMap,           ///< see `tissueMap`
    NoScale,             ///< neither a scale volume with voxels nor one length is chosen
    ScaleWarped,         ///< the scale volume is under a transform that isn't linear
    ScaleTooSmall,       ///< the scale volume leaves out part of the map
    NoEdgeLength,        ///< the one length isn't positive
    ProximityUnfit,      ///< nearest where the edge length is least: 0, or more than where it is most
    LabelTaken,          ///< `tissue` has the label that the surroundings are to have
    NothingToMesh,       ///< every tissue is left out
    LengthsContradict,   ///< `tissue` has a minimum above its maximum
    LengthsOfShellDiffer ///< `tissue` is a shell with two lengths
  };
  struct Check
  {
    Problem problem = Problem::None;
    surgicalmesher::TissueMapProblem tissueMap = surgicalmesher::TissueMapProblem::None;
    surgicalmesher::TissueRow tissue;
  };

  /// `tissues` as surgicalmesher::listTissues gives them for the parameter node's map; without any, only what balloons
  /// need as well is looked at.
  Check FindProblem(vtkMRMLSimplexMesherNode* parameters, const std::vector<surgicalmesher::TissueRow>& tissues);

  /// Starts a run, unless there is a problem or a run is busy. A surface that isn't chosen is made for it, and put into
  /// the parameter node once the run completes. False if it could not be started: GetRun()->GetErrorText() has the
  /// reason.
  bool Start(vtkMRMLSimplexMesherNode* parameters);
  /// The same, waiting for its end in this thread.
  bool StartAndWait(vtkMRMLSimplexMesherNode* parameters);

  /// The one run of this logic: its status, its error, its end. By the time that others see its CompletedEvent, if they
  /// observe it with the default priority, the results have been finished.
  vtkSurgicalMesherRun* GetRun() const { return this->Run; }

  /// What runs BalloonSurfaceCLI for the same parameter nodes.
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
  vtkWeakPointer<vtkMRMLSimplexMesherNode> Parameters; ///< of the run
  vtkWeakPointer<vtkMRMLModelNode> Surface;            ///< of the run
  std::string ReportFile;                              ///< of the run; empty if none is wanted
  surgicalmesher::BalloonRun Balloons{ this };
  /// Volumes that the run is to fill, each with the hidden one that the host reads into.
  std::vector<std::pair<vtkWeakPointer<vtkMRMLVolumeNode>, vtkSmartPointer<vtkMRMLVolumeNode>>> Volumes;
};
