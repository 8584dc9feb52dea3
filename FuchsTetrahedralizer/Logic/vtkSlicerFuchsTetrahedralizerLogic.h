// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs FuchsTetrahedralizerCLI for a parameter node; shows, measures and exports the tetrahedra that it leaves, and
/// those of any other model node.

#include "vtkSlicerFuchsTetrahedralizerModuleLogicExport.h"

#include <vtkSlicerModuleLogic.h>

#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <map>
#include <string>
#include <vector>

class vtkCallbackCommand;
class vtkMRMLFuchsTetrahedralizerNode;
class vtkMRMLModelNode;
class vtkMRMLPlotChartNode;
class vtkMRMLScalarVolumeNode;
class vtkMRMLSliceNode;
class vtkMRMLTableNode;
class vtkSurgicalMesherRun;

class VTK_SLICER_FUCHSTETRAHEDRALIZER_MODULE_LOGIC_EXPORT vtkSlicerFuchsTetrahedralizerLogic
  : public vtkSlicerModuleLogic
{
public:
  static vtkSlicerFuchsTetrahedralizerLogic* New();
  vtkTypeMacro(vtkSlicerFuchsTetrahedralizerLogic, vtkSlicerModuleLogic);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The scene's first parameter node, made if there is none; null without a scene.
  vtkMRMLFuchsTetrahedralizerNode* ParameterNode();

  // ---- before a run -------------------------------------------------------------------------------------------------

  /// What keeps a parameter node from being run.
  enum class Problem
  {
    None,
    NoModule,            ///< FuchsTetrahedralizerCLI isn't loaded
    NoSurface,           ///< no model is chosen
    NotASurface,         ///< `node` holds no triangles: it is empty, or a volume mesh
    LabelledAmongOthers, ///< `node` has labels on both sides of its triangles, so it has to be alone
    NoTargetLengths,     ///< the lengths are to be the surface's own, and it has none
    NoScale,             ///< no scale volume with voxels is chosen
    ScaleWarped,         ///< the scale volume is under a transform that isn't linear
    NoEdgeLength,        ///< the one length isn't positive
    AmbientChanged,      ///< the surface was edited since its ambient tetrahedra were made
    OutputIsInput,       ///< `node` is both, or two outputs at once
    NotAPath,            ///< `node`, chosen as a path, has fewer than two points
    NoTargets,           ///< a distance from targets is asked for, but no target has a point
    NoPaths,             ///< a distance from paths is asked for, but no path is chosen
    NoPlaces,            ///< a nonlinear distance is asked for, but neither target nor path is chosen
    NoDistance,          ///< targets or paths are chosen, but no distance from them
    NoEntryDistance,     ///< a distance at the target end of paths is asked for, but none at the entry
    NoNonlinearEntry,    ///< the same of the nonlinear distance, or without a path
    UnknownShell,        ///< `text` is no tissue of the surface
    ShellsUnused,        ///< a model of shells is asked for, but no tissue becomes one
    BadMaterials         ///< `text` says what is wrong with the materials file
  };
  struct Check
  {
    Problem problem = Problem::None;
    vtkMRMLNode* node = nullptr;
    std::string text;
  };
  Check FindProblem(vtkMRMLFuchsTetrahedralizerNode* parameters);

  /// What is chosen as surface.
  struct Surface
  {
    bool isLabelled = false;
    bool hasTargetLengths = false;
    int tissues = 0; ///< of a labelled surface
    vtkIdType triangles = 0;
    vtkMRMLModelNode* ambient = nullptr; ///< tetrahedra that Simplex Mesher left with it, or null
  };
  Surface DescribeSurface(vtkMRMLFuchsTetrahedralizerNode* parameters);

  /// Models of the scene that could be meshed: labelled surfaces, the latest last.
  std::vector<vtkMRMLModelNode*> LabelledSurfaces();

  // ---- runs ---------------------------------------------------------------------------------------------------------

  /// Starts a run, unless there is a problem or a run is busy. Its results go to the chosen models when it has
  /// completed, and only then; a model for the mesh is made if none is chosen. False if it could not be started:
  /// GetRun()->GetErrorText() has the reason.
  bool Start(vtkMRMLFuchsTetrahedralizerNode* parameters);
  /// The same, waiting for its end in this thread.
  bool StartAndWait(vtkMRMLFuchsTetrahedralizerNode* parameters);

  /// The one run of this logic: its status, its error, its end. By the time that others see its CompletedEvent, if they
  /// observe it with the default priority, the results have been finished: coloured, cut open, measured. Where a
  /// surface was refused for some of its triangles, a new model shows these.
  vtkSurgicalMesherRun* GetRun() const { return this->Run; }

  // ---- any tetrahedra -----------------------------------------------------------------------------------------------

  /// Whether the model holds an unstructured grid.
  static bool IsMesh(vtkMRMLModelNode* mesh);

  /// Colours, plane and edges of the mesh follow the parameter node. False if the mesh lacks what the colours tell.
  bool UpdateDisplay(vtkMRMLFuchsTetrahedralizerNode* parameters);
  /// The slice that cuts the mesh; null for none.
  vtkMRMLSliceNode* GetClipSlice(vtkMRMLFuchsTetrahedralizerNode* parameters);
  /// Least and greatest offset of the clip slice that meet the mesh, mm. False if there is nothing to cut.
  bool GetClipRange(vtkMRMLFuchsTetrahedralizerNode* parameters, double range[2]);

  enum Histogram
  {
    DihedralAngles,
    EdgeLengths,
    Valences,
    RadiusRatios,
    Histogram_Last
  };
  static vtkMRMLPlotChartNode* GetHistogram(vtkMRMLModelNode* mesh, int histogram);
  static vtkMRMLTableNode* GetQualityTable(vtkMRMLModelNode* mesh);
  /// Makes table and histograms of a mesh from elsewhere. Empty, or a sentence on what is wrong with it.
  std::string Assess(vtkMRMLModelNode* mesh);

  /// File endings with their dots and what reads them, in the order of a file dialog.
  struct Format
  {
    std::string extension;
    std::string description;
  };
  static std::vector<Format> GetExportFormats();
  /// Writes the parameter node's mesh, in world coordinates, with its materials and shells, in the format that the
  /// file's ending says: the file that FuchsTetrahedralizerCLI --export writes. Empty, or a sentence on what went
  /// wrong; files appear whole or not at all.
  std::string Export(vtkMRMLFuchsTetrahedralizerNode* parameters, const std::string& file);

protected:
  vtkSlicerFuchsTetrahedralizerLogic();
  ~vtkSlicerFuchsTetrahedralizerLogic() override;
  vtkSlicerFuchsTetrahedralizerLogic(const vtkSlicerFuchsTetrahedralizerLogic&) = delete;
  void operator=(const vtkSlicerFuchsTetrahedralizerLogic&) = delete;

  void RegisterNodes() override;

private:
  bool Prepare(vtkMRMLFuchsTetrahedralizerNode* parameters);
  void PrepareSurface(vtkMRMLFuchsTetrahedralizerNode* parameters);
  void PrepareLengths(vtkMRMLFuchsTetrahedralizerNode* parameters);
  void PrepareConstitutiveClasses(vtkMRMLFuchsTetrahedralizerNode* parameters);
  void PrepareOutputs(vtkMRMLFuchsTetrahedralizerNode* parameters);
  void OnRunEvent(unsigned long event);
  void ShowTrianglesAtFault();
  void FinishRun();
  vtkMRMLModelNode* TakeResult(const std::string& role);
  void FinishMesh(vtkMRMLModelNode* mesh);

  vtkNew<vtkSurgicalMesherRun> Run;
  vtkNew<vtkCallbackCommand> RunEvents;
  vtkWeakPointer<vtkMRMLFuchsTetrahedralizerNode> Parameters;       ///< of the run
  std::map<std::string, vtkSmartPointer<vtkMRMLModelNode>> Results; ///< of the run, by output role
  std::string ReportFile;                                           ///< of the run
  std::string OffendingTrianglesFile;                               ///< of the run; empty unless the surface is refused
  struct AmbientCheck; ///< the last answer of belongTogether(), which takes its time
  AmbientCheck* const LastAmbientCheck;
};
