// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Distances to surgical targets and paths. All coordinates are in mm, in one frame of the caller's choice.

#include "Vec3.h"

#include <vector>

namespace surgicalmesher
{

/// A surgical path linearised into segments, from entry (first point) to target (last point): the set S of Audette et
/// al., Computer Aided Surgery 12(1), 2007.
using Path = std::vector<Vec3>;

/// Where the surgeon works.
struct Focus
{
  std::vector<Vec3> targets;
  std::vector<Path> paths; ///< of two points or more each
};

/// Distance from x to the nearest of `points` (d_R, the minimum over several centres); infinity if there are none.
double distanceToPoints(const Vec3& x, const std::vector<Vec3>& points);

/// Distance from x to the segment ab; a and b may coincide.
double distanceToSegment(const Vec3& x, const Vec3& a, const Vec3& b);

/// Distance from x to the nearest segment of the nearest path (d_SP); infinity if there are none.
double distanceToPaths(const Vec3& x, const std::vector<Path>& paths);

double pathLength(const Path& path);

/// Distance from x to the tube around `path` whose radius varies linearly with arc length from `atEntry` to `atTarget`:
/// the minimum over all points p of the path of |x - p| - radius(p). Negative inside, zero on its wall.
double distanceToTube(const Vec3& x, const Path& path, double atEntry, double atTarget);

} // namespace surgicalmesher
