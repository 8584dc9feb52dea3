// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points and paths of markups nodes, in LPS mm as the project's files have them, with parent transforms applied.

#include "TissueMapIO.h"
#include "vtkSurgicalMesherSupportLogicExport.h"

#include <string>
#include <vector>

class vtkMRMLMarkupsNode;

namespace surgicalmesher
{

/// The placed control points; none for null.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT std::vector<Vec3> markupsPoints(vtkMRMLMarkupsNode* node);

/// The same with their labels.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT Markup labelledPoints(vtkMRMLMarkupsNode* node);

/// Points that are placed from now on, however they are placed, have this label, and so has one that is being placed.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void labelNewPoints(vtkMRMLMarkupsNode* node, const std::string& label);

/// A polyline from entry to target: the control points of a line, of a list of points or of a curve of straight pieces;
/// of a smooth curve the points between which the host draws it. A closed curve ends with its first point again. Empty
/// with fewer than two points.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT std::vector<Vec3> markupsPath(vtkMRMLMarkupsNode* node);

/// Writes lists of points, one markup each, as a .mrk.json from which readMarkups reads exactly the same lists again.
/// Throws InputError if the file cannot be written.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void writeMarkups(const std::vector<std::vector<Vec3>>& markups,
                                                          const std::string& file);

/// The same with the points' labels, for readLabelledMarkups.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void writeLabelledMarkups(const std::vector<Markup>& markups,
                                                                  const std::string& file);

} // namespace surgicalmesher
