// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A path drawn to the axis of the tube it follows, and the tube's radius along it. All in the grid frame, mm.

#include "FluxField.h"

#include <functional>
#include <vector>

namespace surgicalmesher
{

double polylineLength(const std::vector<Vec3>& points);

/// Points at equal distances along a polyline, about `step` apart, its ends among them.
std::vector<Vec3> resampled(const std::vector<Vec3>& points, double step);

/// Unit tangents of points at equal distances, by differences over two neighbours on either side.
std::vector<Vec3> tangentsOf(const std::vector<Vec3>& points);

/// Minimises the sum of step * weight * |x - y|^2 over the points plus the integral of stiffness |x''|^2, with free
/// ends (Whittaker's and Reinsch's smoothing spline on equal steps). `stiffness` (mm^3) by point.
std::vector<Vec3> smoothed(const std::vector<Vec3>& y, const std::vector<double>& weights,
                           const std::vector<double>& stiffness, double step);

/// Moves a path to the ridge of `ridge` (at least 0), carried on by three voxels' lengths at both ends so that
/// these are as sure as the rest: six times, each point to the centroid of what is over 70 %
/// of the largest value in a disc of one voxel's length across the path, then smoothing with that value as weight. The
/// stiffness falls where the path bends, so that smoothing moves no bend by more than a fiftieth of a voxel.
std::vector<Vec3> refinedPath(const Grid& grid, const std::function<double(const Vec3&)>& ridge,
                              const std::vector<Vec3>& path);

/// The path between the planes across it that hold the first and the last of `ends`: cut there, or carried on straight.
std::vector<Vec3> fittedToEnds(std::vector<Vec3> path, const Vec3& first, const Vec3& last);

/// Radius of the tube at each point: that of the straight tube, blurred by one voxel, whose flux into spheres of all
/// radii is nearest to the flux found along the path nearby. Points are at equal distances.
std::vector<double> radiiAlong(const FluxField& field, int sign, const std::vector<Vec3>& path);

} // namespace surgicalmesher
