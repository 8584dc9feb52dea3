// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parameter node of Simplex Mesher, saved with the scene: the map, the settings of its tissues, and the wanted
/// results. Lengths in mm, volumes in mm^3; 0 has the same meaning as in SimplexMesherCLI.

#include "TissueSettings.h"
#include "vtkMRMLSurgicalMesherParameterNode.h"
#include "vtkSlicerSimplexMesherModuleMRMLExport.h"

#include <map>
#include <set>
#include <string>

class VTK_SLICER_SIMPLEXMESHER_MODULE_MRML_EXPORT vtkMRMLSimplexMesherNode : public vtkMRMLSurgicalMesherParameterNode
{
public:
  static vtkMRMLSimplexMesherNode* New();
  vtkTypeMacro(vtkMRMLSimplexMesherNode, vtkMRMLSurgicalMesherParameterNode);

  vtkMRMLNode* CreateNodeInstance() override;
  const char* GetNodeTagName() override { return "SimplexMesher"; }

  /// Roles of the referenced nodes.
  static const char* TissueMapRole() { return "tissueMap"; }               ///< label map or segmentation
  static const char* ScaleRole() { return "scale"; }                       ///< scalar volume of edge lengths
  static const char* SurfaceRole() { return "surface"; }                   ///< model; created if there is none
  static const char* PreparedLabelMapRole() { return "preparedLabelMap"; } ///< label map; none: not wanted
  static const char* SimplexMeshRole() { return "simplexMesh"; }           ///< model; none: not wanted
  static const char* FollowedScaleRole() { return "followedScale"; }       ///< scalar volume; none: not wanted
  static const char* TissueTableRole() { return "tissueTable"; }           ///< table: report by tissue
  static const char* EvolutionTableRole() { return "evolutionTable"; }     ///< table: report step by step
  static const char* ShapeTableRole() { return "shapeTable"; }             ///< table: roughness, folds and ears
  static const char* FoldTableRole() { return "foldTable"; }               ///< table: the longest folds
  static const char* EarTableRole() { return "earTable"; }                 ///< table: the largest ears
  static const char* EvolutionChartRole() { return "evolutionChart"; }     ///< plots of the evolution table
  static const char* BalloonSeedsRole() { return "balloonSeeds"; }         ///< list of points
  static const char* BalloonSurfaceRole() { return "balloonSurface"; }     ///< model; created if there is none
  static const char* BalloonLabelMapRole() { return "balloonLabelMap"; }   ///< label map; created if there is none
  /// Role on the *surface* node: model of the tetrahedra around it.
  static const char* AmbientTetrahedraRole() { return "ambientTetrahedra"; }

  /// Whether edge lengths come from the scale volume; otherwise EdgeLength applies everywhere.
  vtkGetMacro(UseScale, bool);
  vtkSetMacro(UseScale, bool);
  vtkBooleanMacro(UseScale, bool);
  vtkGetMacro(EdgeLength, double);
  vtkSetMacro(EdgeLength, double);

  vtkGetMacro(MinimumIslandVolume, double);
  vtkSetMacro(MinimumIslandVolume, double);
  vtkGetMacro(MinimumCavityVolume, double);
  vtkSetMacro(MinimumCavityVolume, double);
  vtkGetMacro(FeatureScale, double);
  vtkSetMacro(FeatureScale, double);
  vtkGetMacro(Smoothing, double); ///< voxels
  vtkSetMacro(Smoothing, double);
  vtkGetMacro(Rigidity, double);
  vtkSetMacro(Rigidity, double);
  /// Continuity of the internal force of the simplex mesh.
  enum ContinuityType
  {
    EvenEdges,     ///< C0
    NoBend,        ///< C1
    MeanCurvature, ///< C2
    Continuity_Last
  };
  vtkGetMacro(Continuity, int);
  void SetContinuity(int continuity);
  vtkGetMacro(MaximumDistance, double);
  vtkSetMacro(MaximumDistance, double);
  /// Proximity where the edge length is smallest, and where it is largest; both 0: not requested.
  vtkGetMacro(ProximityNear, double);
  vtkSetMacro(ProximityNear, double);
  vtkGetMacro(ProximityFar, double);
  vtkSetMacro(ProximityFar, double);
  vtkGetMacro(ChordError, double);
  vtkSetMacro(ChordError, double);
  /// Label of the surroundings as a tissue; 0: they are not meshed.
  vtkGetMacro(Background, int);
  vtkSetMacro(Background, int);
  vtkGetMacro(FollowThickness, bool);
  vtkSetMacro(FollowThickness, bool);
  vtkBooleanMacro(FollowThickness, bool);
  vtkGetMacro(Gradation, double);
  vtkSetMacro(Gradation, double);
  vtkGetMacro(Threads, int);
  vtkSetMacro(Threads, int);

  /// Whether to create a model for every tissue as well.
  vtkGetMacro(TissueModels, bool);
  vtkSetMacro(TissueModels, bool);
  vtkBooleanMacro(TissueModels, bool);
  /// Whether to keep the tetrahedra around the surface for the volume stage.
  vtkGetMacro(KeepAmbient, bool);
  vtkSetMacro(KeepAmbient, bool);
  vtkBooleanMacro(KeepAmbient, bool);
  /// Whether to create tables and plots.
  vtkGetMacro(Report, bool);
  vtkSetMacro(Report, bool);
  vtkBooleanMacro(Report, bool);

  /// Balloons: the tissues that stop them, by segment ID or, in a label map, by the label as text; the largest distance
  /// from their seeds; the width of the openings that they do not enter.
  const std::set<std::string>& GetBalloonStops() const { return this->BalloonStops; }
  void SetBalloonStops(const std::set<std::string>& ids);
  vtkGetMacro(BalloonLimit, double);
  vtkSetMacro(BalloonLimit, double);
  vtkGetMacro(BalloonRigidity, double);
  vtkSetMacro(BalloonRigidity, double);

  /// Settings of tissues, by segment ID or, in a label map, by the label as text. Tissues that are not listed are
  /// meshed as they are.
  using Settings = std::map<std::string, surgicalmesher::TissueSetting>;
  const Settings& GetTissueSettings() const { return this->TissueSettings; }
  void SetTissueSettings(const Settings& settings);
  surgicalmesher::TissueSetting GetTissueSetting(const std::string& id) const;
  void SetTissueSetting(const std::string& id, const surgicalmesher::TissueSetting& setting);

protected:
  vtkMRMLSimplexMesherNode();
  ~vtkMRMLSimplexMesherNode() override = default;
  vtkMRMLSimplexMesherNode(const vtkMRMLSimplexMesherNode&) = delete;
  void operator=(const vtkMRMLSimplexMesherNode&) = delete;

  std::vector<Value> GetValues() override;

  /// The settings as one line of text: records end with ';', fields with '|'; these characters and '%' are written as
  /// %XX.
  std::string GetTissues() const;
  void SetTissues(const std::string& text);

  /// The IDs of the stops, encoded as in GetTissues.
  std::string GetStops() const;
  void SetStops(const std::string& text);

  bool UseScale = true;
  double EdgeLength = 2;
  double MinimumIslandVolume = 0;
  double MinimumCavityVolume = 0;
  double FeatureScale = 0;
  double Smoothing = 0.7;
  double Rigidity = 0.28;
  int Continuity = MeanCurvature;
  double MaximumDistance = 0;
  double ProximityNear = 0;
  double ProximityFar = 0;
  double ChordError = 0;
  int Background = 0;
  bool FollowThickness = false;
  double Gradation = 0.3;
  int Threads = 0;
  bool TissueModels = false;
  bool KeepAmbient = true;
  bool Report = true;
  Settings TissueSettings;
  std::set<std::string> BalloonStops;
  double BalloonLimit = 0;
  double BalloonRigidity = 8;
};
