// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parameters of the Tissue Mapper panel. The node is part of the scene and saved with it.

#include "vtkMRMLSurgicalMesherParameterNode.h"
#include "vtkSlicerTissueMapperModuleMRMLExport.h"

#include <vtkCommand.h>

#include <string>
#include <vector>

class vtkMRMLMarkupsNode;

class VTK_SLICER_TISSUEMAPPER_MODULE_MRML_EXPORT vtkMRMLTissueMapperNode : public vtkMRMLSurgicalMesherParameterNode
{
public:
  static vtkMRMLTissueMapperNode* New();
  vtkTypeMacro(vtkMRMLTissueMapperNode, vtkMRMLSurgicalMesherParameterNode);

  vtkMRMLNode* CreateNodeInstance() override;
  const char* GetNodeTagName() override { return "TissueMapper"; }
  /// Forwards changes of the inputs as InputModifiedEvent; markups report changes of their points by several events.
  void ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData) override;

  enum Events
  {
    InputModifiedEvent = vtkCommand::UserEvent + 20 ///< an input's points, voxels or transform changed
  };

  /// Roles of the referenced nodes.
  static const char* ImageRole() { return "image"; }        ///< scalar volume: MR of a head, or a CT
  static const char* SecondImageRole() { return "image2"; } ///< further images on the same grid
  static const char* ThirdImageRole() { return "image3"; }
  static const char* FourthImageRole() { return "image4"; }
  static const char* TrainingRole() { return "training"; } ///< markups; each point's label is the name of its class
  static const char* LabelMapRole() { return "labelMap"; } ///< label map of the tissues; if empty, a new node is added

  /// Label map of the compartments, in coarse voxels.
  static const char* CompartmentsRole() { return "compartments"; }

  /// Scalar volumes: the moving image is registered to the fixed one.
  static const char* FixedImageRole() { return "fixedImage"; }
  static const char* MovingImageRole() { return "movingImage"; }
  /// Markups; the first point is the target. If empty, the whole image counts equally.
  static const char* TargetRole() { return "target"; }
  static const char* RegisteredImageRole() { return "registeredImage"; } ///< if empty, a new node is added

  /// Image in which the tube is traced; if empty, the first image.
  static const char* TubeImageRole() { return "tubeImage"; }
  static const char* TubePointsRole() { return "tubePoints"; } ///< markups: points on the tube, in order along it
  static const char* TubePathRole() { return "tubePath"; }     ///< curve along the axis; if empty, a new node is added

  /// Returns the chosen images, the first image first.
  std::vector<vtkMRMLScalarVolumeNode*> GetImages();
  vtkMRMLMarkupsNode* GetMarkupsNode(const char* role);

  /// Class of the points being placed.
  vtkGetMacro(TrainingClass, std::string);
  vtkSetMacro(TrainingClass, std::string);
  /// CSV file with the table of classes; empty for none.
  vtkGetMacro(Classes, std::string);
  vtkSetMacro(Classes, std::string);
  vtkGetMacro(CorrectBias, bool);
  vtkSetMacro(CorrectBias, bool);
  vtkGetMacro(Denoise, bool);
  vtkSetMacro(Denoise, bool);
  /// Whether each class is admitted in its compartment only.
  vtkGetMacro(UseCompartments, bool);
  vtkSetMacro(UseCompartments, bool);
  /// Whether the contiguity and limits of the table are applied.
  vtkGetMacro(UseContiguity, bool);
  vtkSetMacro(UseContiguity, bool);
  /// Whether voxels that contiguity takes from a class go to classes nearby.
  vtkGetMacro(UseProximity, bool);
  vtkSetMacro(UseProximity, bool);

  /// Whether compartments are updated at once when points or options change.
  vtkGetMacro(CompartmentsAtOnce, bool);
  vtkSetMacro(CompartmentsAtOnce, bool);

  /// Radius of the sphere around the target, mm.
  vtkGetMacro(TargetRadius, double);
  vtkSetMacro(TargetRadius, double);
  /// "centre" or "principal": what the initial poses of the registration align.
  vtkGetMacro(RegistrationStart, std::string);
  vtkSetMacro(RegistrationStart, std::string);

  /// Returns the image in which a tube is traced; null if there is none.
  vtkMRMLScalarVolumeNode* GetTubeImage();
  /// Name of the tube, as a tissue and as a curve.
  vtkGetMacro(TubeName, std::string);
  vtkSetMacro(TubeName, std::string);
  /// Bounds of the radius, mm; 0 for both: from half a voxel to three and a half voxels.
  vtkGetMacro(MinimumRadius, double);
  vtkSetMacro(MinimumRadius, double);
  vtkGetMacro(MaximumRadius, double);
  vtkSetMacro(MaximumRadius, double);
  /// "auto", "bright" or "dark".
  vtkGetMacro(Polarity, std::string);
  vtkSetMacro(Polarity, std::string);
  /// "flux", "gradient" or "intensity": the potential that the path follows.
  vtkGetMacro(TubePotential, std::string);
  vtkSetMacro(TubePotential, std::string);
  /// Largest distance by which points are moved to the tube, and margin of the search box around the points, mm.
  vtkGetMacro(TubeSnap, double);
  vtkSetMacro(TubeSnap, double);
  vtkGetMacro(TubeMargin, double);
  vtkSetMacro(TubeMargin, double);
  /// Whether the path is updated at once when the points change.
  vtkGetMacro(TraceAtOnce, bool);
  vtkSetMacro(TraceAtOnce, bool);

protected:
  vtkMRMLTissueMapperNode();
  ~vtkMRMLTissueMapperNode() override = default;
  vtkMRMLTissueMapperNode(const vtkMRMLTissueMapperNode&) = delete;
  void operator=(const vtkMRMLTissueMapperNode&) = delete;

  std::vector<Value> GetValues() override;

  std::string TrainingClass = "CSF";
  std::string Classes;
  bool CorrectBias = false;
  bool Denoise = false;
  bool UseCompartments = true;
  bool UseContiguity = true;
  bool UseProximity = true;
  bool CompartmentsAtOnce = false;
  double TargetRadius = 40;
  std::string RegistrationStart = "centre";
  std::string TubeName = "vessel";
  double MinimumRadius = 0;
  double MaximumRadius = 0;
  std::string Polarity = "auto";
  std::string TubePotential = "flux";
  double TubeSnap = 2;
  double TubeMargin = 30;
  bool TraceAtOnce = true;
};
