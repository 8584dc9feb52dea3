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

/// The placed points of a list, LPS, mm; none for null.
NamedPoints namedPoints(vtkMRMLMarkupsNode* list);

/// The landmarks that stand once in both lists, in the template's order.
LandmarkPairs commonPairs(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget);

struct LandmarkRow
{
  std::string name;
  bool onTemplate = false, onTarget = false;
  double leftOut = -1; ///< mm from where the spline of all other pairs would put it; below 0: unknown
  double fitted = -1;  ///< mm from the patient's landmark after the last fit; below 0: unknown
};

/// All names of both lists, the template's first. `fitted` are residuals by name.
VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT std::vector<LandmarkRow>
landmarkRows(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget, const std::map<std::string, double>& fitted);

/// Whether a landmark of the template waits for its partner.
VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT bool isTurnOfTarget(vtkMRMLMarkupsNode* onTemplate,
                                                                     vtkMRMLMarkupsNode* onTarget);

/// The point that is placed next in either list gets the name that has no partner yet, or else a new one.
VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT void nameNextLandmarks(vtkMRMLMarkupsNode* onTemplate,
                                                                        vtkMRMLMarkupsNode* onTarget);

/// Takes the landmark of this name out of both lists.
VTK_SLICER_TEMPLATEHEXMESHER_MODULE_LOGIC_EXPORT void
removeLandmark(const std::string& name, vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget);

} // namespace surgicalmesher
