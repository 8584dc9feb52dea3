// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs BalloonSurfaceCLI for a parameter node: surfaces that grow from a list of points until chosen tissues stop them,
/// as a model, and what they enclose as new tissues of a copy of the label map. Map, edge lengths and threads are those
/// of the surface of all tissues.

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
  NoModule,     ///< BalloonSurfaceCLI isn't loaded
  NoSeeds,      ///< no list of points is chosen, or none of them is placed
  NothingStops, ///< none of the map's tissues is chosen
};

class VTK_SLICER_SIMPLEXMESHER_MODULE_LOGIC_EXPORT BalloonRun
{
public:
  /// `logic` is the module's, and outlives this.
  explicit BalloonRun(vtkSlicerModuleLogic* logic);
  ~BalloonRun();
  BalloonRun(const BalloonRun&) = delete;
  void operator=(const BalloonRun&) = delete;

  /// What keeps a parameter node from being run, besides its map and its edge lengths.
  BalloonProblem findProblem(vtkMRMLSimplexMesherNode* parameters) const;

  /// Starts a run, unless there is a problem or a run is busy. Results that aren't chosen are made for it, and put into
  /// the parameter node once the run completes. The map and the edge lengths are to be free of problems
  /// (vtkSlicerSimplexMesherLogic::FindProblem).
  bool start(vtkMRMLSimplexMesherNode* parameters);

  /// The newest surface that the run has left so far, in a hidden model of its own that goes with the run. False if
  /// there is none newer than the one shown. To be called now and then.
  bool showGrowth();
  vtkMRMLModelNode* growth() const; ///< null unless a run is busy

  vtkSurgicalMesherRun* run() const { return m_Run; }

private:
  bool prepare(vtkMRMLSimplexMesherNode* parameters);
  void prepareOutputs(vtkMRMLSimplexMesherNode* parameters);
  void finish();

  vtkSlicerModuleLogic* m_Logic;
  vtkNew<vtkSurgicalMesherRun> m_Run;
  vtkNew<vtkCallbackCommand> m_RunEnded;
  vtkWeakPointer<vtkMRMLSimplexMesherNode> m_Parameters;
  vtkWeakPointer<vtkMRMLModelNode> m_Surface, m_Growth;
  vtkSmartPointer<vtkMRMLLabelMapVolumeNode> m_LabelMap; ///< hidden, for the host to read into
  std::string m_GrowthIndex;                             ///< what `--growth` is given
  int m_ShownMotion = 0;
};

} // namespace surgicalmesher
