// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Landmarks as two lists of control points, matched by their labels.

#include "Landmarks.h"
#include "vtkSlicerTemplateHexMesherModuleLogicExport.h"

#include <map>
#include <string>
#include <vector>

class vtkMRMLMarkupsNode;

namespace surgicalmesher
{

/// Returns the placed points of a list, LPS, mm; empty for a null list.
NamedPoints namedPoints(vtkMRMLMarkupsNode* list);

/// Returns the landmarks whose names occur exactly once in both lists, in the template's order.
LandmarkPairs commonPairs(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget);

struct LandmarkRow
{
  std::string name;
  bool onTemplate = false, onTarget = false;
  double leftOut = -1; ///< distance (mm) from where the spline of all other pairs puts it; below 0: unknown
  double fitted = -1;  ///< mm from the patient's landmark after the last fit; below 0: unknown
};

/// Returns a row for every name in the two lists, those of the template first. `fitted` are residuals by name.
VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT std::vector<LandmarkRow>
landmarkRows(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget, const std::map<std::string, double>& fitted);

/// Whether a landmark of the template has no partner on the target yet.
VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT bool isTurnOfTarget(vtkMRMLMarkupsNode* onTemplate,
                                                                     vtkMRMLMarkupsNode* onTarget);

/// Names the next point to be placed in each list: after the first landmark without a partner there, or else by a new
/// name.
VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT void nameNextLandmarks(vtkMRMLMarkupsNode* onTemplate,
                                                                        vtkMRMLMarkupsNode* onTarget);

/// Takes the landmark of this name out of both lists.
VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT void
removeLandmark(const std::string& name, vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget);

} // namespace surgicalmesher
