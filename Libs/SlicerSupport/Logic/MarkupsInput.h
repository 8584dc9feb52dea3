// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points and paths of markups nodes in LPS mm, as in the project's files, with parent transforms applied.

#include "TissueMapIO.h"
#include "vtkSurgicalMesherSupportLogicExport.h"

#include <string>
#include <vector>

class vtkMRMLMarkupsNode;

namespace surgicalmesher
{

/// Returns the positions of the placed control points; none for null.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT std::vector<Vec3> markupsPoints(vtkMRMLMarkupsNode* node);

/// Returns the placed control points with their labels.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT Markup labelledPoints(vtkMRMLMarkupsNode* node);

/// Sets the label of all points placed from now on, including the one being placed.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void labelNewPoints(vtkMRMLMarkupsNode* node, const std::string& label);

/// Returns the polyline from entry to target: the control points of a line, of a point list or of a piecewise linear
/// curve; for a smooth curve, the points of the drawn polyline. A closed curve ends with its first point again. Empty
/// if there are fewer than two points.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT std::vector<Vec3> markupsPath(vtkMRMLMarkupsNode* node);

/// Writes lists of points, one markup each, to a .mrk.json file from which readMarkups reads exactly the same lists.
/// Throws InputError if the file cannot be written.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void writeMarkups(const std::vector<std::vector<Vec3>>& markups,
                                                          const std::string& file);

/// The same with the labels of the points, for readLabelledMarkups.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void writeLabelledMarkups(const std::vector<Markup>& markups,
                                                                  const std::string& file);

} // namespace surgicalmesher
