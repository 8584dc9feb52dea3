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

  /// The scene's first parameter node, made if there is none; null without a scene.
  vtkMRMLTemplateHexMesherNode* ParameterNode();

  surgicalmesher::FitCheck FindProblem(vtkMRMLTemplateHexMesherNode* parameters);
  /// Starts a fit. The nodes chosen for results keep their contents until it completes; those that are not chosen are
  /// made then. Returns what kept it from starting; a run that is busy goes on, and nothing is said.
  surgicalmesher::FitCheck Start(vtkMRMLTemplateHexMesherNode* parameters);
  /// The one run of this logic. By the time that others see its CompletedEvent, if they observe it with the default
  /// priority, the results have been finished.
  vtkSurgicalMesherRun* GetRun() const;
  /// Of the fit that completed last; nothing if that was of other parameters.
  surgicalmesher::FitSummary GetFound(vtkMRMLTemplateHexMesherNode* parameters) const;

  /// The landmarks of both lists, with their residuals.
  std::vector<surgicalmesher::LandmarkRow> GetLandmarks(vtkMRMLTemplateHexMesherNode* parameters);

  /// Preview, views and colours follow the parameter node. Nothing is shown or hidden while a run is being started.
  void UpdateDisplay(vtkMRMLTemplateHexMesherNode* parameters);
  /// Null before it was shown.
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
