// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parameter node of Surgical Path Scale, saved with the scene. Names and defaults are those of SurgicalPathScaleCLI;
/// lengths and distances in mm; 0 has the same meaning as in that module.

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
  /// Forwards all events of input nodes (markups have events of their own for their points) as InputModifiedEvent.
  void ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData) override;

  enum Events
  {
    InputModifiedEvent = vtkCommand::UserEvent + 20 ///< points, voxels, segments or transform of an input changed
  };

  /// Roles of the referenced nodes.
  static const char* TissueMapRole() { return "tissueMap"; } ///< label map or segmentation
  static const char* TargetsRole() { return "targets"; }     ///< markups; every point is a target
  static const char* PathRole() { return "path"; }           ///< markups from entry to target
  /// Any number of markups: curves and lines are paths, others targets.
  static const char* FurtherMarkupsRole() { return "furtherMarkups"; }
  static const char* ScaleRole() { return "scale"; } ///< scalar volume; created by the run if there is none
  /// Label map with null displacement; created by the run if there is none.
  static const char* OutputLabelMapRole() { return "outputLabelMap"; }
  static const char* ProfileChartRole() { return "profileChart"; } ///< plot of length over distance; none: not wanted

  /// Returns all markups whose points are targets; nodes that have left the scene are skipped.
  std::vector<vtkMRMLMarkupsNode*> GetTargetNodes();
  /// Returns all markups that are paths, one path each.
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
  /// CSV file with lengths by tissue; empty: none.
  vtkGetMacro(TissueLengths, std::string);
  vtkSetMacro(TissueLengths, std::string);

  /// Whether null displacement is wanted, i.e. whether the radius or the path distance is positive.
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
