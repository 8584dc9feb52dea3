// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the panel of Tissue Mapper shows. It lives in the scene and is saved with it.

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
  /// Markups tell of their points by events of their own; all of them arrive here as InputModifiedEvent.
  void ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData) override;

  enum Events
  {
    InputModifiedEvent = vtkCommand::UserEvent + 20 ///< an input's points, voxels or transform changed
  };

  /// Roles of the nodes referred to.
  static const char* ImageRole() { return "image"; }        ///< scalar volume: MR of a head, or a CT
  static const char* SecondImageRole() { return "image2"; } ///< further ones on the same grid
  static const char* ThirdImageRole() { return "image3"; }
  static const char* FourthImageRole() { return "image4"; }
  static const char* TrainingRole() { return "training"; } ///< markups; each point's label is the name of its class
  static const char* LabelMapRole() { return "labelMap"; } ///< the tissues; a new one where there is none

  static const char* CompartmentsRole()
  {
    return "compartments";
  } ///< label map: where classes may be, in coarse voxels

  static const char* FixedImageRole() { return "fixedImage"; } ///< scalar volumes: one stays, the other comes onto it
  static const char* MovingImageRole() { return "movingImage"; }
  static const char* TargetRole()
  {
    return "target";
  } ///< markups; the first point is what counts most; none: all alike
  static const char* RegisteredImageRole() { return "registeredImage"; } ///< a new one where there is none

  static const char* TubeImageRole() { return "tubeImage"; }   ///< where a tube is followed; none: the first image
  static const char* TubePointsRole() { return "tubePoints"; } ///< markups: points on the tube, in its order
  static const char* TubePathRole() { return "tubePath"; }     ///< curve along its axis; a new one where there is none

  /// Those that are chosen, the first one first.
  std::vector<vtkMRMLScalarVolumeNode*> GetImages();
  vtkMRMLMarkupsNode* GetMarkupsNode(const char* role);

  /// The class of which points are placed.
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
  /// Whether contiguity and limits of the table count.
  vtkGetMacro(UseContiguity, bool);
  vtkSetMacro(UseContiguity, bool);
  /// Whether what contiguity takes away goes only to classes that are near.
  vtkGetMacro(UseProximity, bool);
  vtkSetMacro(UseProximity, bool);

  /// Whether compartments follow the points and options at once.
  vtkGetMacro(CompartmentsAtOnce, bool);
  vtkSetMacro(CompartmentsAtOnce, bool);

  /// Of the sphere around the target, mm.
  vtkGetMacro(TargetRadius, double);
  vtkSetMacro(TargetRadius, double);
  /// "centre" or "principal": what the first guesses of registration lay on each other.
  vtkGetMacro(RegistrationStart, std::string);
  vtkSetMacro(RegistrationStart, std::string);

  /// The image that a tube is followed in; null if there is none.
  vtkMRMLScalarVolumeNode* GetTubeImage();
  /// Of the tube, as a tissue and as a curve.
  vtkGetMacro(TubeName, std::string);
  vtkSetMacro(TubeName, std::string);
  /// mm; 0 for both: half a voxel to three and a half voxels.
  vtkGetMacro(MinimumRadius, double);
  vtkSetMacro(MinimumRadius, double);
  vtkGetMacro(MaximumRadius, double);
  vtkSetMacro(MaximumRadius, double);
  /// "auto", "bright" or "dark".
  vtkGetMacro(Polarity, std::string);
  vtkSetMacro(Polarity, std::string);
  /// "flux", "gradient" or "intensity": what the path follows.
  vtkGetMacro(TubePotential, std::string);
  vtkSetMacro(TubePotential, std::string);
  /// mm; how far points may be moved onto the tube, and by how much the box that the path lies in is larger than theirs.
  vtkGetMacro(TubeSnap, double);
  vtkSetMacro(TubeSnap, double);
  vtkGetMacro(TubeMargin, double);
  vtkSetMacro(TubeMargin, double);
  /// Whether the path follows the points at once.
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
