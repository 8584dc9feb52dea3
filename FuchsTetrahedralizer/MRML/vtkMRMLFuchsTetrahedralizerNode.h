// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the panel of Fuchs Tetrahedralizer shows: the surface, the lengths, what is wanted of the mesh and how it is
/// looked at. It lives in the scene and is saved with it. Lengths are in mm; 0 means what it means to
/// FuchsTetrahedralizerCLI.

#include "vtkSlicerFuchsTetrahedralizerModuleMRMLExport.h"

#include <vtkMRMLNode.h>

#include <string>
#include <vector>

class vtkMRMLModelNode;

class VTK_SLICER_FUCHSTETRAHEDRALIZER_MODULE_MRML_EXPORT vtkMRMLFuchsTetrahedralizerNode : public vtkMRMLNode
{
public:
  static vtkMRMLFuchsTetrahedralizerNode* New();
  vtkTypeMacro(vtkMRMLFuchsTetrahedralizerNode, vtkMRMLNode);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkMRMLNode* CreateNodeInstance() override;
  const char* GetNodeTagName() override { return "FuchsTetrahedralizer"; }
  void ReadXMLAttributes(const char** atts) override;
  void WriteXML(ostream& of, int indent) override;
  void CopyContent(vtkMRMLNode* node, bool deepCopy = true) override;

  /// Where edge lengths come from.
  enum EdgeLengthSourceType
  {
    FromSurface, ///< the surface's own TargetEdgeLength
    FromScale,   ///< the scale volume
    Uniform,     ///< EdgeLength, everywhere
    EdgeLengthSource_Last
  };

  /// What the mesh's colours tell.
  enum ColorByType
  {
    Tissue,
    SubMesh,
    ConstitutiveClass,
    MinimumDihedralAngle,
    RadiusRatio,
    ColorBy_Last
  };

  /// The slice that the mesh is cut at.
  enum ClipPlaneType
  {
    NoPlane,
    Axial,    ///< red
    Sagittal, ///< yellow
    Coronal,  ///< green
    ClipPlane_Last
  };

  /// Roles of the nodes referred to. Inputs:
  static const char* SurfaceRole(); ///< one model with BoundaryLabels, or closed models, in this order
  static const char* ScaleRole();   ///< scalar volume of edge lengths
  static const char* TargetRole();  ///< markups; their points are targets of constitutive classes
  static const char* PathRole();    ///< markups; each is a path from entry to target
  /// Outputs; models.
  static const char* MeshRole();       ///< a new one where there is none
  static const char* ParentMeshRole(); ///< none: not wanted, as below
  static const char* ChildMeshRole();
  static const char* ShellsRole();
  /// Of the *surface* node: model of the tetrahedra around it, a head start.
  static const char* AmbientTetrahedraRole();
  /// Of the *mesh* node.
  static const char* QualityTableRole(); ///< table, one row per group of tetrahedra
  static const char* HistogramRole();    ///< plot charts, in the order of vtkSlicerFuchsTetrahedralizerLogic::Histogram

  /// Refers to `node`, which may be null, in `role`, and to no other.
  void SetNode(const char* role, vtkMRMLNode* node);
  void SetNodes(const char* role, const std::vector<vtkMRMLNode*>& nodes);
  /// Those that are in the scene.
  std::vector<vtkMRMLNode*> GetNodes(const char* role);
  vtkMRMLModelNode* GetModelNode(const char* role);

  vtkGetMacro(EdgeLengthSource, int);
  void SetEdgeLengthSource(int source);
  static const char* GetEdgeLengthSourceAsString(int source);
  static int GetEdgeLengthSourceFromString(const char* name);
  vtkGetMacro(EdgeLength, double);
  vtkSetMacro(EdgeLength, double);
  /// Whether the surface's ambient tetrahedra are begun from where there are such.
  vtkGetMacro(UseAmbient, bool);
  vtkSetMacro(UseAmbient, bool);
  vtkBooleanMacro(UseAmbient, bool);

  /// Tissues whose boundaries become shells, as --shell takes them, separated by commas.
  vtkGetMacro(ShellTissues, std::string);
  vtkSetMacro(ShellTissues, std::string);
  vtkGetMacro(ShellThickness, double);
  vtkSetMacro(ShellThickness, double);
  /// CSV file, see Docs/FuchsTetrahedralizer.md; empty: all tissues have the default material.
  vtkGetMacro(MaterialsFile, std::string);
  vtkSetMacro(MaterialsFile, std::string);

  vtkGetMacro(NonlinearDistance, double);
  vtkSetMacro(NonlinearDistance, double);
  vtkGetMacro(NullDisplacementRadius, double);
  vtkSetMacro(NullDisplacementRadius, double);
  vtkGetMacro(NullDisplacementPathDistance, double);
  vtkSetMacro(NullDisplacementPathDistance, double);
  vtkGetMacro(NullDisplacementPathDistanceAtTarget, double);
  vtkSetMacro(NullDisplacementPathDistanceAtTarget, double);

  /// Whether the table of quality also tells the stiffness matrix's conditioning.
  vtkGetMacro(Conditioning, bool);
  vtkSetMacro(Conditioning, bool);
  vtkBooleanMacro(Conditioning, bool);
  vtkGetMacro(Threads, int);
  vtkSetMacro(Threads, int);

  vtkGetMacro(ColorBy, int);
  void SetColorBy(int colorBy);
  static const char* GetColorByAsString(int colorBy);
  static int GetColorByFromString(const char* name);
  vtkGetMacro(ClipPlane, int);
  void SetClipPlane(int plane);
  static const char* GetClipPlaneAsString(int plane);
  static int GetClipPlaneFromString(const char* name);
  /// Whether the other side of the plane is shown.
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

  int EdgeLengthSource = FromSurface;
  double EdgeLength = 2;
  bool UseAmbient = true;
  std::string ShellTissues;
  double ShellThickness = 1;
  std::string MaterialsFile;
  double NonlinearDistance = 0;
  double NullDisplacementRadius = 0;
  double NullDisplacementPathDistance = 0;
  double NullDisplacementPathDistanceAtTarget = 0;
  bool Conditioning = false;
  int Threads = 0;
  int ColorBy = Tissue;
  int ClipPlane = Coronal; // seen from in front, as by default, it shows the inside
  bool ClipFlipped = false;
  bool ShowEdges = true;
};
