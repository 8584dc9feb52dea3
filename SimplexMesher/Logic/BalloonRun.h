// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs BalloonSurfaceCLI for a parameter node: the surfaces that grow from a list of points until the chosen tissues
/// stop them become a model, and the voxels they enclose become new tissues in a copy of the label map. Map, edge
/// lengths and threads are those of the surface of all tissues.

#include "vtkSlicerSimplexMesherModuleLogicExport.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <string>

class vtkCallbackCommand;
class vtkMRMLLabelMapVolumeNode;
class vtkMRMLModelNode;
class vtkMRMLSimplexMesherNode;
class vtkSlicerModuleLogic;
class vtkSurgicalMesherRun;

namespace surgicalmesher
{

enum class BalloonProblem
{
  None,
  NoModule,     ///< BalloonSurfaceCLI is not loaded
  NoSeeds,      ///< no list of points is chosen, or none of its points is placed
  NothingStops, ///< none of the map's tissues is chosen
};

class VTK_SLICER_SIMPLEXMESHER_MODULE_LOGIC_EXPORT BalloonRun
{
public:
  /// `logic` is the logic of the module and must outlive this object.
  explicit BalloonRun(vtkSlicerModuleLogic* logic);
  ~BalloonRun();
  BalloonRun(const BalloonRun&) = delete;
  void operator=(const BalloonRun&) = delete;

  /// Returns why a parameter node cannot be run, apart from its map and edge lengths.
  BalloonProblem findProblem(vtkMRMLSimplexMesherNode* parameters) const;

  /// Starts a run, unless there is a problem or a run is busy. Returns false if it could not be started; for other
  /// reasons than these, the run's GetErrorText() has them. Outputs without a node are created, and set in the
  /// parameter node once the run completes. The map and the edge lengths must be free of problems
  /// (vtkSlicerSimplexMesherLogic::FindProblem).
  bool start(vtkMRMLSimplexMesherNode* parameters);

  /// Shows the newest surface of the run so far in a hidden model that is removed with the run. Returns false if there
  /// is none newer than the one shown. To be called periodically.
  bool showGrowth();
  vtkMRMLModelNode* growth() const; ///< null unless a run is busy

  vtkSurgicalMesherRun* run() const { return m_Run; }

private:
  bool prepare(vtkMRMLSimplexMesherNode* parameters);
  bool prepareSeeds(vtkMRMLSimplexMesherNode* parameters);
  void prepareOutputs(vtkMRMLSimplexMesherNode* parameters);
  void finish();

  vtkSlicerModuleLogic* m_Logic;
  vtkNew<vtkSurgicalMesherRun> m_Run;
  vtkNew<vtkCallbackCommand> m_RunEnded;
  vtkWeakPointer<vtkMRMLSimplexMesherNode> m_Parameters;
  vtkWeakPointer<vtkMRMLModelNode> m_Surface, m_Growth;
  vtkSmartPointer<vtkMRMLLabelMapVolumeNode> m_LabelMap; ///< hidden, for Slicer to read into
  std::string m_GrowthIndex;                             ///< value of `--growth`
  int m_ShownMotion = 0;
};

} // namespace surgicalmesher
