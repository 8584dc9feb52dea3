// SPDX-License-Identifier: Apache-2.0
#include "SurfaceDistance.h"

#include "Parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;

struct Sample
{
  Vector3d position;
  double area;
  double distance = 0;
};

/// Divides a triangle into n^2 congruent parts, with n such that no edge is longer than `spacing` (at most 100), and
/// adds their centroids.
void addSamples(const Vector3d& a, const Vector3d& b, const Vector3d& c, double spacing, std::vector<Sample>& samples)
{
  const double longest = std::sqrt(std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() }));
  const int n = std::clamp(int(std::ceil(longest / spacing)), 1, 100);
  const double area = (b - a).cross(c - a).norm() / 2 / (n * n);
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; i + j < n; ++j)
    {
      const auto at = [&](double u, double v) -> Vector3d { return a + (b - a) * (u / n) + (c - a) * (v / n); };
      samples.push_back({ at(i + 1 / 3., j + 1 / 3.), area });
      if (i + j + 1 < n) samples.push_back({ at(i + 2 / 3., j + 2 / 3.), area });
    }
  }
}

} // namespace

DistanceSummary distanceBetween(const TriangleSurface& from, const TargetSurface& to, double spacing)
{
  std::vector<Sample> samples;
  for (const Triangle& t : from.triangles)
    addSamples(from.points.col(t[0]), from.points.col(t[1]), from.points.col(t[2]), spacing, samples);
  parallelFor(samples.size(),
              [&](std::size_t i)
              {
                Sample& sample = samples[i];
                const SurfacePoint closest = to.closest(sample.position, Vector3d::Zero(), 0);
                sample.distance = (closest.position - sample.position).norm();
              });
  double area = 0, weighted = 0;
  for (const Sample& sample : samples)
  {
    area += sample.area;
    weighted += sample.area * sample.distance;
  }
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.distance < b.distance; });
  DistanceSummary summary;
  if (!(area > 0)) return summary;
  summary.mean = weighted / area;
  summary.maximum = samples.back().distance;
  double below = 0;
  for (const Sample& sample : samples)
  {
    below += sample.area;
    summary.percentile95 = sample.distance;
    if (below >= 0.95 * area) break;
  }
  return summary;
}

} // namespace surgicalmesher
