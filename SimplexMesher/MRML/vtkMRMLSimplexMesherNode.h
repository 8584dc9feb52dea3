// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the panel of Simplex Mesher shows: the map, what is asked of its tissues, and which results are wanted. It
/// lives in the scene and is saved with it. Lengths are in mm, volumes in mm^3; 0 means what it means to
/// SimplexMesherCLI.

#include "vtkSlicerSimplexMesherModuleMRMLExport.h"

#include "TissueSettings.h"

#include <vtkMRMLNode.h>

#include <map>
#include <string>

class vtkMRMLLabelMapVolumeNode;
class vtkMRMLModelNode;
class vtkMRMLPlotChartNode;
class vtkMRMLScalarVolumeNode;
class vtkMRMLTableNode;

class VTK_SLICER_SIMPLEXMESHER_MODULE_MRML_EXPORT vtkMRMLSimplexMesherNode : public vtkMRMLNode
{
public:
  static vtkMRMLSimplexMesherNode* New();
  vtkTypeMacro(vtkMRMLSimplexMesherNode, vtkMRMLNode);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkMRMLNode* CreateNodeInstance() override;
  const char* GetNodeTagName() override { return "SimplexMesher"; }
  void ReadXMLAttributes(const char** atts) override;
  void WriteXML(ostream& of, int indent) override;
  void CopyContent(vtkMRMLNode* node, bool deepCopy = true) override;

  /// Roles of the nodes referred to.
  static const char* TissueMapRole();         ///< label map or segmentation
  static const char* ScaleRole();             ///< scalar volume of edge lengths
  static const char* SurfaceRole();           ///< model; a new one where there is none
  static const char* PreparedLabelMapRole();  ///< label map; none: not wanted
  static const char* SimplexMeshRole();       ///< model; none: not wanted
  static const char* FollowedScaleRole();     ///< scalar volume; none: not wanted
  static const char* TissueTableRole();       ///< table: the report by tissue
  static const char* EvolutionTableRole();    ///< table: the report step by step
  static const char* EvolutionChartRole();    ///< plot of the latter
  static const char* AmbientTetrahedraRole(); ///< of the *surface* node: model of the tetrahedra around it

  vtkMRMLNode* GetTissueMapNode();
  vtkMRMLScalarVolumeNode* GetScaleNode();
  vtkMRMLModelNode* GetSurfaceNode();
  vtkMRMLLabelMapVolumeNode* GetPreparedLabelMapNode();
  vtkMRMLModelNode* GetSimplexMeshNode();
  vtkMRMLScalarVolumeNode* GetFollowedScaleNode();
  vtkMRMLTableNode* GetTissueTableNode();
  vtkMRMLTableNode* GetEvolutionTableNode();
  vtkMRMLPlotChartNode* GetEvolutionChartNode();

  /// Refers to `node`, which may be null, in `role`.
  void SetNode(const char* role, vtkMRMLNode* node);

  /// Whether edge lengths come from the scale volume; otherwise EdgeLength holds everywhere.
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
  vtkGetMacro(MaximumDistance, double);
  vtkSetMacro(MaximumDistance, double);
  vtkGetMacro(FollowThickness, bool);
  vtkSetMacro(FollowThickness, bool);
  vtkBooleanMacro(FollowThickness, bool);
  vtkGetMacro(Gradation, double);
  vtkSetMacro(Gradation, double);
  vtkGetMacro(Threads, int);
  vtkSetMacro(Threads, int);

  /// Whether there is to be a model for every tissue too.
  vtkGetMacro(TissueModels, bool);
  vtkSetMacro(TissueModels, bool);
  vtkBooleanMacro(TissueModels, bool);
  /// Whether the tetrahedra around the surface are kept for the volume stage.
  vtkGetMacro(KeepAmbient, bool);
  vtkSetMacro(KeepAmbient, bool);
  vtkBooleanMacro(KeepAmbient, bool);
  /// Whether there are to be tables and a plot.
  vtkGetMacro(Report, bool);
  vtkSetMacro(Report, bool);
  vtkBooleanMacro(Report, bool);

  /// What is asked of tissues, by segment ID or, in a label map, by the label's digits. Tissues that aren't listed are
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

  /// The settings as one line of text: records end with ';', fields with '|', and both and '%' are written as %XX.
  std::string GetTissues() const;
  void SetTissues(const std::string& text);

  bool UseScale = true;
  double EdgeLength = 2;
  double MinimumIslandVolume = 0;
  double MinimumCavityVolume = 0;
  double FeatureScale = 0;
  double MaximumDistance = 0;
  bool FollowThickness = false;
  double Gradation = 0.3;
  int Threads = 0;
  bool TissueModels = false;
  bool KeepAmbient = true;
  bool Report = true;
  Settings TissueSettings;
};
