// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the panel of Template Hex Mesher shows. It lives in the scene and is saved with it.

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
  /// Markups tell of their points by events of their own; all of them arrive here as InputModifiedEvent.
  void ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData) override;

  enum Events
  {
    InputModifiedEvent = vtkCommand::UserEvent + 20 ///< a landmark, or the transform of one, changed
  };

  /// Roles of the nodes referred to.
  static const char* TemplateRole() { return "template"; } ///< model: hexahedra, or a surface
  static const char* TargetRole() { return "target"; }     ///< model: the patient's surface, or a mesh
  static const char* InnerRole() { return "inner"; }       ///< model: a second surface of the patient, or none
  static const char* CarriedRole() { return "carried"; }   ///< models that go along, any number
  static const char* TemplateLandmarksRole() { return "templateLandmarks"; } ///< markups, matched by their labels
  static const char* TargetLandmarksRole() { return "targetLandmarks"; }
  static const char* FittedRole() { return "fitted"; } ///< model; a new one where there is none
  static const char* CarriedResultRole() { return "carriedResult"; }
  static const char* QualityTableRole() { return "qualityTable"; }

  vtkMRMLMarkupsNode* GetMarkupsNode(const char* role);

  /// Whether the template stands in one 3D view, the patient in another.
  vtkGetMacro(SideBySide, bool);
  vtkSetMacro(SideBySide, bool);
  /// Whether the template is shown as the spline of the landmarks takes it to the patient.
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
  /// Of a landmark's squared distance, against 1 for a point of the surface.
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
