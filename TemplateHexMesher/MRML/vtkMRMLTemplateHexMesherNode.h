// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parameters of the Template Hex Mesher panel. The node is part of the scene and saved with it.

#include "vtkMRMLSurgicalMesherParameterNode.h"
#include "vtkSlicerTemplateHexMesherModuleMRMLExport.h"

#include <vtkCommand.h>

class vtkMRMLMarkupsNode;

class VTK_SLICER_TEMPLATEHEXMESHER_MODULE_MRML_EXPORT vtkMRMLTemplateHexMesherNode
  : public vtkMRMLSurgicalMesherParameterNode
{
public:
  static vtkMRMLTemplateHexMesherNode* New();
  vtkTypeMacro(vtkMRMLTemplateHexMesherNode, vtkMRMLSurgicalMesherParameterNode);

  vtkMRMLNode* CreateNodeInstance() override;
  const char* GetNodeTagName() override { return "TemplateHexMesher"; }
  /// Forwards changes of the landmarks as InputModifiedEvent; markups report changes of their points by several events.
  void ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData) override;

  enum Events
  {
    InputModifiedEvent = vtkCommand::UserEvent + 20 ///< a landmark or the transform of a landmark list changed
  };

  /// Roles of the referenced nodes.
  static const char* TemplateRole() { return "template"; } ///< model: hexahedra, or a surface
  static const char* TargetRole() { return "target"; }     ///< model: the patient's surface, or a mesh
  static const char* InnerRole() { return "inner"; }       ///< model: second surface of the patient; optional
  static const char* CarriedRole() { return "carried"; }   ///< models deformed along with the template, any number
  static const char* TemplateLandmarksRole() { return "templateLandmarks"; } ///< markups, matched by their labels
  static const char* TargetLandmarksRole() { return "targetLandmarks"; }
  static const char* FittedRole() { return "fitted"; } ///< model; if empty, a new node is added
  static const char* CarriedResultRole() { return "carriedResult"; }
  static const char* QualityTableRole() { return "qualityTable"; }

  vtkMRMLMarkupsNode* GetMarkupsNode(const char* role);

  /// Whether template and patient are shown in separate 3D views.
  vtkGetMacro(SideBySide, bool);
  vtkSetMacro(SideBySide, bool);
  /// Whether the template is shown as deformed by the spline of the landmarks alone.
  vtkGetMacro(ShowPreview, bool);
  vtkSetMacro(ShowPreview, bool);
  /// Whether elements are coloured by their scaled Jacobian.
  vtkGetMacro(ColorByQuality, bool);
  vtkSetMacro(ColorByQuality, bool);
  /// Weight of smoothness against closeness.
  vtkGetMacro(Alpha, double);
  vtkSetMacro(Alpha, double);
  /// Steps of descent between two searches for closest points.
  vtkGetMacro(Iterations, int);
  vtkSetMacro(Iterations, int);
  /// Weight of a landmark's squared distance, relative to 1 for a point of the surface.
  vtkGetMacro(LandmarkWeight, double);
  vtkSetMacro(LandmarkWeight, double);

protected:
  vtkMRMLTemplateHexMesherNode();
  ~vtkMRMLTemplateHexMesherNode() override = default;
  vtkMRMLTemplateHexMesherNode(const vtkMRMLTemplateHexMesherNode&) = delete;
  void operator=(const vtkMRMLTemplateHexMesherNode&) = delete;

  std::vector<Value> GetValues() override;

  bool SideBySide = false;
  bool ShowPreview = true;
  bool ColorByQuality = true;
  double Alpha = 1;
  int Iterations = 15;
  double LandmarkWeight = 50;
};
