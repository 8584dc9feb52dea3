// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the panel of Surgical Path Scale shows. It lives in the scene and is saved with it. Names and defaults are
/// those of SurgicalPathScaleCLI; lengths and distances in mm, and 0 means what it means to that module.

#include "vtkMRMLSurgicalMesherParameterNode.h"
#include "vtkSlicerSurgicalPathScaleModuleMRMLExport.h"

#include <vtkCommand.h>

#include <string>
#include <vector>

class vtkMRMLMarkupsNode;

class VTK_SLICER_SURGICALPATHSCALE_MODULE_MRML_EXPORT vtkMRMLSurgicalPathScaleNode
  : public vtkMRMLSurgicalMesherParameterNode
{
public:
  static vtkMRMLSurgicalPathScaleNode* New();
  vtkTypeMacro(vtkMRMLSurgicalPathScaleNode, vtkMRMLSurgicalMesherParameterNode);

  vtkMRMLNode* CreateNodeInstance() override;
  const char* GetNodeTagName() override { return "SurgicalPathScale"; }
  /// Markups tell of their points by events of their own; all of them arrive here as InputModifiedEvent.
  void ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData) override;

  enum Events
  {
    InputModifiedEvent = vtkCommand::UserEvent + 20 ///< an input's points, voxels, segments or transform changed
  };

  /// Roles of the nodes referred to.
  static const char* TissueMapRole() { return "tissueMap"; } ///< label map or segmentation
  static const char* TargetsRole() { return "targets"; }     ///< markups, of which every point is a target
  static const char* PathRole() { return "path"; }           ///< markups from entry to target
  /// Any number: curves and lines are paths, others targets.
  static const char* FurtherMarkupsRole() { return "furtherMarkups"; }
  static const char* ScaleRole() { return "scale"; } ///< scalar volume; a new one where there is none
  /// Label map with null displacement; a new one where there is none.
  static const char* OutputLabelMapRole() { return "outputLabelMap"; }
  static const char* ProfileChartRole() { return "profileChart"; } ///< plot of length over distance; none: not wanted

  /// All markups of which every point is a target; none that have left the scene.
  std::vector<vtkMRMLMarkupsNode*> GetTargetNodes();
  /// All markups that are a path each.
  std::vector<vtkMRMLMarkupsNode*> GetPathNodes();

  vtkGetMacro(MinimumEdgeLength, double);
  vtkSetMacro(MinimumEdgeLength, double);
  vtkGetMacro(MaximumEdgeLength, double);
  vtkSetMacro(MaximumEdgeLength, double);
  vtkGetMacro(ChildRadius, double);
  vtkSetMacro(ChildRadius, double);
  vtkGetMacro(DecayLength, double);
  vtkSetMacro(DecayLength, double);
  vtkGetMacro(Spacing, double);
  vtkSetMacro(Spacing, double);
  vtkGetMacro(PathChildRadius, double);
  vtkSetMacro(PathChildRadius, double);
  vtkGetMacro(PathDecayLength, double);
  vtkSetMacro(PathDecayLength, double);
  vtkGetMacro(Gradation, double);
  vtkSetMacro(Gradation, double);
  /// "smaller", "targets" or "path".
  vtkGetMacro(Combine, std::string);
  vtkSetMacro(Combine, std::string);
  /// CSV file with lengths by tissue; empty for none.
  vtkGetMacro(TissueLengths, std::string);
  vtkSetMacro(TissueLengths, std::string);

  /// Whether tissue is to become null displacement: if either of the first two is positive.
  bool WantsNullDisplacement() const;
  vtkGetMacro(NullDisplacementRadius, double);
  vtkSetMacro(NullDisplacementRadius, double);
  vtkGetMacro(NullDisplacementPathDistance, double);
  vtkSetMacro(NullDisplacementPathDistance, double);
  vtkGetMacro(NullDisplacementPathDistanceAtTarget, double);
  vtkSetMacro(NullDisplacementPathDistanceAtTarget, double);
  /// Labels or names separated by commas; empty for all tissues.
  vtkGetMacro(NullDisplacementTissues, std::string);
  vtkSetMacro(NullDisplacementTissues, std::string);

protected:
  vtkMRMLSurgicalPathScaleNode();
  ~vtkMRMLSurgicalPathScaleNode() override = default;
  vtkMRMLSurgicalPathScaleNode(const vtkMRMLSurgicalPathScaleNode&) = delete;
  void operator=(const vtkMRMLSurgicalPathScaleNode&) = delete;

  std::vector<Value> GetValues() override;

  double MinimumEdgeLength = 1;
  double MaximumEdgeLength = 8;
  double ChildRadius = 10;
  double DecayLength = 25;
  double Spacing = 2;
  double PathChildRadius = 0;
  double PathDecayLength = 0;
  double Gradation = 0;
  std::string Combine = "smaller";
  std::string TissueLengths;
  double NullDisplacementRadius = 0;
  double NullDisplacementPathDistance = 0;
  double NullDisplacementPathDistanceAtTarget = 0;
  std::string NullDisplacementTissues;
};
