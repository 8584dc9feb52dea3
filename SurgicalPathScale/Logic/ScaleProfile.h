// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The plot of edge length over distance (figure 4 of Audette et al., Computer Aided Surgery 12(1), 2007).

#include "vtkSlicerSurgicalPathScaleModuleLogicExport.h"

class vtkMRMLPlotChartNode;
class vtkMRMLSurgicalPathScaleNode;

namespace surgicalmesher
{

/// Fills the parameter node's chart with its table and its two series, and creates in the scene those that are missing.
/// The series of paths is visible only if paths have distances of their own.
VTK_SLICER_SURGICALPATHSCALE_MODULE_LOGIC_EXPORT vtkMRMLPlotChartNode*
plotProfile(vtkMRMLSurgicalPathScaleNode* parameters);

/// Removes the chart, its series and its tables from the scene.
VTK_SLICER_SURGICALPATHSCALE_MODULE_LOGIC_EXPORT void removeProfile(vtkMRMLSurgicalPathScaleNode* parameters);

} // namespace surgicalmesher
