// SPDX-License-Identifier: Apache-2.0
#include "Distance.h"

#include <algorithm>
#include <limits>

namespace surgicalmesher
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Distance from x to the round cone around segment ab. Along the axis, |x - p| - radius(p) is convex, and least where
/// the sine of the angle at which x sees the axis equals the slope of the radius.
double distanceToRoundCone(const Vec3& x, const Vec3& a, const Vec3& b, double radiusA, double radiusB)
{
  const Vec3 axis = b - a;
  const double length = norm(axis);
  const double slope = length > 0 ? (radiusB - radiusA) / length : 0;
  const double along = length > 0 ? dot(x - a, axis) / length : 0;
  const double across = std::sqrt(std::max(0.0, squaredNorm(x - a) - along * along));
  double foot = slope > 0 ? length : 0;
  if (std::abs(slope) < 1) foot = along + across * slope / std::sqrt(1 - slope * slope);
  foot = std::min(std::max(foot, 0.0), length);
  return std::hypot(foot - along, across) - (radiusA + slope * foot);
}

} // namespace

double distanceToPoints(const Vec3& x, const std::vector<Vec3>& points)
{
  double squared = infinity;
  for (const Vec3& point : points) squared = std::min(squared, squaredNorm(x - point));
  return std::sqrt(squared);
}

double distanceToSegment(const Vec3& x, const Vec3& a, const Vec3& b)
{
  const Vec3 axis = b - a;
  const double squaredLength = squaredNorm(axis);
  const double u = squaredLength > 0 ? std::min(std::max(dot(x - a, axis) / squaredLength, 0.0), 1.0) : 0;
  return norm(x - (a + u * axis));
}

double distanceToPaths(const Vec3& x, const std::vector<Path>& paths)
{
  double distance = infinity;
  for (const Path& path : paths)
  {
    for (std::size_t n = 1; n < path.size(); ++n)
      distance = std::min(distance, distanceToSegment(x, path[n - 1], path[n]));
  }
  return distance;
}

double pathLength(const Path& path)
{
  double length = 0;
  for (std::size_t n = 1; n < path.size(); ++n) length += norm(path[n] - path[n - 1]);
  return length;
}

double distanceToTube(const Vec3& x, const Path& path, double atEntry, double atTarget)
{
  const double length = pathLength(path);
  const double slope = length > 0 ? (atTarget - atEntry) / length : 0;
  double distance = infinity;
  double arc = 0;
  for (std::size_t n = 1; n < path.size(); ++n)
  {
    const double next = arc + norm(path[n] - path[n - 1]);
    distance =
      std::min(distance, distanceToRoundCone(x, path[n - 1], path[n], atEntry + slope * arc, atEntry + slope * next));
    arc = next;
  }
  return distance;
}

} // namespace surgicalmesher
