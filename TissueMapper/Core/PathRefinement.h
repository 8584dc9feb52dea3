// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Refinement of a path to the axis of the tube that it follows, and the radius of the tube along the path. All
/// positions and lengths are in the grid frame, mm.

#include "FluxField.h"

#include <functional>
#include <vector>

namespace surgicalmesher
{

double polylineLength(const std::vector<Vec3>& points);

/// Returns points at equal distances along a polyline, about `step` apart, including both ends.
std::vector<Vec3> resampled(const std::vector<Vec3>& points, double step);

/// Returns the unit tangents at points at equal distances, from differences over two neighbours on either side.
std::vector<Vec3> tangentsOf(const std::vector<Vec3>& points);

/// Minimises the sum of step * weight * |x - y|^2 over the points plus the integral of stiffness |x''|^2, with free
/// ends (Whittaker's and Reinsch's smoothing spline on equal steps). `stiffness` (mm^4) by point.
std::vector<Vec3> smoothed(const std::vector<Vec3>& y, const std::vector<double>& weights,
                           const std::vector<double>& stiffness, double step);

/// Moves a path to the ridge line of `ridge` (at least 0). The path is first extended by three voxel lengths at both
/// ends, so that its ends are as reliable as the rest. Each of six rounds moves every point to the centroid of what
/// exceeds 70 % of the largest value in a disc across the path, one voxel length in radius, and then smooths the path
/// with that value as weight. The stiffness decreases where the path bends, so that smoothing moves bends by about a
/// fiftieth of a voxel.
std::vector<Vec3> refinedPath(const Grid& grid, const std::function<double(const Vec3&)>& ridge,
                              const std::vector<Vec3>& path);

/// Cuts or extends the path so that its ends lie in the planes across it through `first` and `last`; extensions are
/// straight.
std::vector<Vec3> fittedToEnds(std::vector<Vec3> path, const Vec3& first, const Vec3& last);

/// Returns the radius of the tube at each point: that of the straight tube, blurred by one voxel, whose flux into
/// spheres of all radii fits best the flux found along the path nearby. The points of `path` are at equal distances.
std::vector<double> radiiAlong(const FluxField& field, int sign, const std::vector<Vec3>& path);

} // namespace surgicalmesher
