// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs FuchsTetrahedralizerCLI for a parameter node; displays, assesses and exports the resulting tetrahedra and those
/// of any other model node.

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

  /// Returns the first parameter node of the scene, created if there is none; null without a scene.
  vtkMRMLFuchsTetrahedralizerNode* ParameterNode();

  // ---- before a run -------------------------------------------------------------------------------------------------

  /// Reasons why a parameter node cannot be run.
  enum class Problem
  {
    None,
    NoModule,            ///< FuchsTetrahedralizerCLI is not loaded
    NoSurface,           ///< no model is chosen
    NotASurface,         ///< `node` has no triangles: it is empty, or a volume mesh
    LabelledAmongOthers, ///< `node` has labels on both sides of its triangles and must be the only surface
    NoTargetLengths,     ///< lengths are to come from the surface, which has none
    NoScale,             ///< no scale volume with voxels is chosen
    ScaleWarped,         ///< the scale volume is under a nonlinear transform
    NoEdgeLength,        ///< the uniform edge length is not positive
    AmbientChanged,      ///< the surface was edited after its ambient tetrahedra were made
    OutputIsInput,       ///< `node` is both input and output, or two outputs
    NotAPath,            ///< `node`, chosen as a path, has fewer than two points
    NoTargets,           ///< a distance from targets is given, but no target has a point
    NoPaths,             ///< a distance from paths is given, but no path is chosen
    NoPlaces,            ///< a nonlinear distance is given, but neither target nor path is chosen
    NoDistance,          ///< targets or paths are chosen, but no distance from them
    NoEntryDistance,     ///< a distance at the target end of paths is given, but none at the entry
    NoNonlinearEntry,    ///< the same for the nonlinear distance, or it is given without a path
    UnknownShell,        ///< `text` does not name tissues of the surface
    ShellsUnused,        ///< an output for shells is chosen, but no tissue becomes a shell
    BadMaterials         ///< `text` is the error in the materials file
  };
  struct Check
  {
    Problem problem = Problem::None;
    vtkMRMLNode* node = nullptr;
    std::string text;
  };
  Check FindProblem(vtkMRMLFuchsTetrahedralizerNode* parameters);

  /// Description of the chosen surface.
  struct Surface
  {
    bool isLabelled = false;
    bool hasTargetLengths = false;
    int tissues = 0; ///< of a labelled surface
    vtkIdType triangles = 0;
    vtkMRMLModelNode* ambient = nullptr; ///< tetrahedra that Simplex Mesher made with it, or null
  };
  Surface DescribeSurface(vtkMRMLFuchsTetrahedralizerNode* parameters);

  /// Returns the labelled surfaces of the scene, which could be meshed, the latest last.
  std::vector<vtkMRMLModelNode*> LabelledSurfaces();

  // ---- runs ---------------------------------------------------------------------------------------------------------

  /// Starts a run, unless there is a problem or a run is busy. The results are moved to the chosen models only when the
  /// run has completed; a model for the mesh is created if none is chosen. Returns false if the run could not be
  /// started: FindProblem() or GetRun()->GetErrorText() has the reason.
  bool Start(vtkMRMLFuchsTetrahedralizerNode* parameters);
  /// The same, but waits in this thread for the end of the run.
  bool StartAndWait(vtkMRMLFuchsTetrahedralizerNode* parameters);

  /// The only run of this logic, with its status, error and end. Observers of its CompletedEvent with the default
  /// priority see finished results: coloured, clipped, assessed. If a surface was refused because of some of its
  /// triangles, a new model shows these.
  vtkSurgicalMesherRun* GetRun() const { return this->Run; }

  // ---- any tetrahedra -----------------------------------------------------------------------------------------------

  /// Whether the model holds an unstructured grid with cells.
  static bool IsMesh(vtkMRMLModelNode* mesh);

  /// Applies colours, clip plane and edges of the parameter node to the mesh. Returns false if the mesh lacks the data
  /// to colour by.
  bool UpdateDisplay(vtkMRMLFuchsTetrahedralizerNode* parameters);
  /// Returns the slice that clips the mesh; null if there is none.
  vtkMRMLSliceNode* GetClipSlice(vtkMRMLFuchsTetrahedralizerNode* parameters);
  /// Returns in `range` the smallest and largest offset of the clip slice that intersect the mesh, mm. False if there
  /// is nothing to clip.
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
  /// Creates table and histograms for a mesh from another source. Returns an empty text, or the error.
  std::string Assess(vtkMRMLModelNode* mesh);

  /// File extensions with their dots and the programs that read them, in the order of the file dialog.
  struct Format
  {
    std::string extension;
    std::string description;
  };
  static std::vector<Format> GetExportFormats();
  /// Whether a file's extension is that of one of these formats.
  static bool HasExportExtension(const std::string& file);
  /// Writes the parameter node's mesh in world coordinates, with its materials and shells, in the format given by the
  /// file extension: the same file as that of FuchsTetrahedralizerCLI --export. Returns an empty text, or the error;
  /// files appear completely or not at all.
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
  vtkWeakPointer<vtkMRMLFuchsTetrahedralizerNode> Parameters;       ///< of the current run
  std::map<std::string, vtkSmartPointer<vtkMRMLModelNode>> Results; ///< of the current run, by output role
  std::string ReportFile;                                           ///< of the current run
  /// Of the current run; the file is empty unless the surface is refused.
  std::string OffendingTrianglesFile;
  struct AmbientCheck; ///< caches the last result of belongTogether(), which takes time
  AmbientCheck* const LastAmbientCheck;
};
