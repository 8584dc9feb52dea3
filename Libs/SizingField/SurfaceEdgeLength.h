// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Target edge lengths for a surface: from its own points, or from a scale volume around it.

#include "ScaleField.h"
#include "SizingFunction.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Returns L(x) that is the length (mm) at the nearest of the points, such as the TargetEdgeLength of a surface.
SizingFunction edgeLengthFromPoints(const std::vector<Vec3>& points, const std::vector<double>& lengths);

/// Throws InputError, with `scaleFile` and the place, if a point lies outside the scale's volume (voxel centres plus
/// half a voxel) by more than half the edge length there: a mesher may have moved the surface slightly out of the map.
void requireCover(const ScaleField& scale, const std::vector<Vec3>& points, const std::string& scaleFile);

} // namespace surgicalmesher
