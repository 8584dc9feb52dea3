// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parameter node of Fuchs Tetrahedralizer, saved with the scene: the surface, the edge lengths, the wanted outputs,
/// and the display of the mesh. Lengths in mm; 0 has the same meaning as in FuchsTetrahedralizerCLI.

#include "vtkMRMLSurgicalMesherParameterNode.h"
#include "vtkSlicerFuchsTetrahedralizerModuleMRMLExport.h"

#include <string>
#include <vector>

class VTK_SLICER_FUCHSTETRAHEDRALIZER_MODULE_MRML_EXPORT vtkMRMLFuchsTetrahedralizerNode
  : public vtkMRMLSurgicalMesherParameterNode
{
public:
  static vtkMRMLFuchsTetrahedralizerNode* New();
  vtkTypeMacro(vtkMRMLFuchsTetrahedralizerNode, vtkMRMLSurgicalMesherParameterNode);

  vtkMRMLNode* CreateNodeInstance() override;
  const char* GetNodeTagName() override { return "FuchsTetrahedralizer"; }

  /// Source of the edge lengths.
  enum EdgeLengthSourceType
  {
    FromSurface, ///< the surface's own TargetEdgeLength
    FromScale,   ///< the scale volume
    Uniform,     ///< EdgeLength, everywhere
    EdgeLengthSource_Last
  };

  /// Property of the mesh shown by its colours.
  enum ColorByType
  {
    Tissue,
    SubMesh,
    ConstitutiveClass,
    MinimumDihedralAngle,
    RadiusRatio,
    ColorBy_Last
  };

  /// The slice at which the mesh is clipped.
  enum ClipPlaneType
  {
    NoPlane,
    Axial,    ///< red
    Sagittal, ///< yellow
    Coronal,  ///< green
    ClipPlane_Last
  };

  /// Type of tetrahedra in exports.
  enum ExportElementsType
  {
    FourNodes,
    TenNodes,       ///< straight sides
    TenNodesCurved, ///< sides that follow the boundaries of tissues
    ExportElements_Last
  };

  /// As surgicalmesher::Units.
  enum ExportUnitsType
  {
    Millimetres,
    SI,
    ExportUnits_Last
  };

  /// Roles of the referenced nodes. Inputs:
  /// A model with BoundaryLabels, or closed models, in this order.
  static const char* SurfaceRole() { return "surface"; }
  static const char* ScaleRole() { return "scale"; }   ///< scalar volume of edge lengths
  static const char* TargetRole() { return "target"; } ///< markups; their points are targets of constitutive classes
  static const char* PathRole() { return "path"; }     ///< markups; each is a path from entry to target
  /// Outputs, all models:
  static const char* MeshRole() { return "mesh"; }             ///< created if there is none
  static const char* ParentMeshRole() { return "parentMesh"; } ///< none: not wanted; likewise the following
  static const char* ChildMeshRole() { return "childMesh"; }
  static const char* ShellsRole() { return "shells"; }
  /// Role on the *surface* node: model of the tetrahedra around it, from which meshing can start.
  static const char* AmbientTetrahedraRole() { return "ambientTetrahedra"; }
  /// Roles on the *mesh* node:
  static const char* QualityTableRole() { return "qualityTable"; } ///< table, one row per group of tetrahedra
  /// Plot charts, in the order of vtkSlicerFuchsTetrahedralizerLogic::Histogram.
  static const char* HistogramRole() { return "histogram"; }

  vtkGetMacro(EdgeLengthSource, int);
  void SetEdgeLengthSource(int source);
  vtkGetMacro(EdgeLength, double);
  vtkSetMacro(EdgeLength, double);
  /// Whether to start from the surface's ambient tetrahedra, if there are any.
  vtkGetMacro(UseAmbient, bool);
  vtkSetMacro(UseAmbient, bool);
  vtkBooleanMacro(UseAmbient, bool);

  /// Tissues whose boundaries become shells, in the format of --shell, separated by commas.
  vtkGetMacro(ShellTissues, std::string);
  vtkSetMacro(ShellTissues, std::string);
  vtkGetMacro(ShellThickness, double);
  vtkSetMacro(ShellThickness, double);
  /// CSV file, see Docs/FuchsTetrahedralizer.md; empty: all tissues have the default material.
  vtkGetMacro(MaterialsFile, std::string);
  vtkSetMacro(MaterialsFile, std::string);

  vtkGetMacro(NonlinearDistance, double);
  vtkSetMacro(NonlinearDistance, double);
  /// At the target end of paths; 0: the same as at the entry.
  vtkGetMacro(NonlinearDistanceAtTarget, double);
  vtkSetMacro(NonlinearDistanceAtTarget, double);
  vtkGetMacro(NullDisplacementRadius, double);
  vtkSetMacro(NullDisplacementRadius, double);
  vtkGetMacro(NullDisplacementPathDistance, double);
  vtkSetMacro(NullDisplacementPathDistance, double);
  vtkGetMacro(NullDisplacementPathDistanceAtTarget, double);
  vtkSetMacro(NullDisplacementPathDistanceAtTarget, double);

  /// Whether the quality table includes the conditioning of the stiffness matrix.
  vtkGetMacro(Conditioning, bool);
  vtkSetMacro(Conditioning, bool);
  vtkBooleanMacro(Conditioning, bool);
  /// Degrees; for surfaces not made by Simplex Mesher.
  vtkGetMacro(FeatureAngle, double);
  vtkSetMacro(FeatureAngle, double);
  vtkGetMacro(Threads, int);
  vtkSetMacro(Threads, int);

  vtkGetMacro(ExportElements, int);
  void SetExportElements(int elements);
  vtkGetMacro(ExportUnits, int);
  void SetExportUnits(int units);

  vtkGetMacro(ColorBy, int);
  void SetColorBy(int colorBy);
  vtkGetMacro(ClipPlane, int);
  void SetClipPlane(int plane);
  /// Whether to show the other side of the plane.
  vtkGetMacro(ClipFlipped, bool);
  vtkSetMacro(ClipFlipped, bool);
  vtkBooleanMacro(ClipFlipped, bool);
  vtkGetMacro(ShowEdges, bool);
  vtkSetMacro(ShowEdges, bool);
  vtkBooleanMacro(ShowEdges, bool);

protected:
  vtkMRMLFuchsTetrahedralizerNode();
  ~vtkMRMLFuchsTetrahedralizerNode() override = default;
  vtkMRMLFuchsTetrahedralizerNode(const vtkMRMLFuchsTetrahedralizerNode&) = delete;
  void operator=(const vtkMRMLFuchsTetrahedralizerNode&) = delete;

  std::vector<Value> GetValues() override;

  int EdgeLengthSource = FromSurface;
  double EdgeLength = 2;
  bool UseAmbient = true;
  std::string ShellTissues;
  double ShellThickness = 1;
  std::string MaterialsFile;
  double NonlinearDistance = 0;
  double NonlinearDistanceAtTarget = 0;
  double NullDisplacementRadius = 0;
  double NullDisplacementPathDistance = 0;
  double NullDisplacementPathDistanceAtTarget = 0;
  bool Conditioning = false;
  double FeatureAngle = 40;
  int Threads = 0;
  int ExportElements = FourNodes;
  int ExportUnits = Millimetres;
  int ColorBy = Tissue;
  int ClipPlane = Coronal; // seen from the front, the default view, it shows the inside
  bool ClipFlipped = false;
  bool ShowEdges = true;
};
