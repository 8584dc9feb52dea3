// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs TemplateFitCLI for a parameter node, and shows landmarks, preview and results.

#include "FitTask.h"
#include "LandmarkLists.h"
#include "SplinePreview.h"
#include "TemplateViews.h"
#include "vtkSlicerTemplateHexMesherModuleLogicExport.h"

#include <vtkSlicerModuleLogic.h>

#include <memory>
#include <vector>

class vtkMRMLModelNode;
class vtkMRMLTemplateHexMesherNode;
class vtkSurgicalMesherRun;

class VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT vtkSlicerTemplateHexMesherLogic : public vtkSlicerModuleLogic
{
public:
  static vtkSlicerTemplateHexMesherLogic* New();
  vtkTypeMacro(vtkSlicerTemplateHexMesherLogic, vtkSlicerModuleLogic);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Returns the scene's first parameter node; adds one if there is none. Null without a scene.
  vtkMRMLTemplateHexMesherNode* ParameterNode();

  /// Returns the first reason why a fit cannot be started; None if it can.
  surgicalmesher::FitCheck FindProblem(vtkMRMLTemplateHexMesherNode* parameters);
  /// Starts a fit. The nodes chosen for results keep their contents until the run completes; where none is chosen, a
  /// new node is added then. Returns the reason why the run could not be started. Does nothing if a run is in progress.
  surgicalmesher::FitCheck Start(vtkMRMLTemplateHexMesherNode* parameters);
  /// The run of this logic. Results are delivered before observers of its CompletedEvent with the default priority are
  /// called.
  vtkSurgicalMesherRun* GetRun() const;
  /// Result of the last completed fit; empty if that fit had another parameter node.
  surgicalmesher::FitSummary GetFound(vtkMRMLTemplateHexMesherNode* parameters) const;

  /// The landmarks of both lists, with their residuals.
  std::vector<surgicalmesher::LandmarkRow> GetLandmarks(vtkMRMLTemplateHexMesherNode* parameters);

  /// Updates preview, views and colours from the parameter node. Does nothing while a run is being started.
  void UpdateDisplay(vtkMRMLTemplateHexMesherNode* parameters);
  /// Null until the preview is first shown.
  vtkMRMLModelNode* GetPreview() const;

protected:
  vtkSlicerTemplateHexMesherLogic();
  ~vtkSlicerTemplateHexMesherLogic() override;
  vtkSlicerTemplateHexMesherLogic(const vtkSlicerTemplateHexMesherLogic&) = delete;
  void operator=(const vtkSlicerTemplateHexMesherLogic&) = delete;

  void RegisterNodes() override;

private:
  std::unique_ptr<surgicalmesher::FitTask> Fit;
  surgicalmesher::SplinePreview Preview;
  surgicalmesher::TemplateViews Views;
};
