// SPDX-License-Identifier: Apache-2.0
#include "CurvatureScale.h"

#include "SimplexForces.h"

#include <queue>

namespace surgicalmesher
{

namespace
{

std::vector<std::vector<std::int32_t>> neighboursOf(const SurfaceComplex& surface)
{
  std::vector<std::vector<std::int32_t>> neighbours(surface.points.size());
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k)
    {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
      neighbours[t[k]].push_back(t[(k + 2) % 3]);
    }
  for (auto& list : neighbours)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

/// Returns the largest change of the normal per mm at each point; 0 on curves, where the normal is not unique.
std::vector<double> surfaceCurvatures(const SurfaceComplex& surface,
                                      const std::vector<std::vector<std::int32_t>>& neighbours,
                                      const std::vector<bool>& isOnCurve)
{
  constexpr int sweeps = 3; // sweeps of smoothing, so that the steps of voxels do not count as curvature
  std::vector<Vec3> normals = pointNormals(surface);
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    std::vector<Vec3> means = normals;
    for (std::size_t p = 0; p < means.size(); ++p)
    {
      for (const std::int32_t n : neighbours[p])
        if (!isOnCurve[p] && !isOnCurve[n]) means[p] += normals[n];
      means[p] = means[p] / std::max(1e-300, norm(means[p]));
    }
    normals = std::move(means);
  }
  std::vector<double> curvatures(surface.points.size(), 0);
  for (std::size_t p = 0; p < curvatures.size(); ++p)
    for (const std::int32_t n : neighbours[p])
      if (!isOnCurve[p] && !isOnCurve[n])
        curvatures[p] = std::max(curvatures[p], norm(normals[n] - normals[p]) /
                                                  std::max(1e-300, norm(surface.points[n] - surface.points[p])));
  return curvatures;
}

void limitRise(const SurfaceComplex& surface, const std::vector<std::vector<std::int32_t>>& neighbours,
               std::vector<double>& lengths)
{
  constexpr double slope = 0.5;
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (std::size_t p = 0; p < lengths.size(); ++p) front.emplace(lengths[p], std::int32_t(p));
  while (!front.empty())
  {
    const auto [length, p] = front.top();
    front.pop();
    if (length > lengths[p]) continue;
    for (const std::int32_t n : neighbours[p])
    {
      const double most = length + slope * norm(surface.points[n] - surface.points[p]);
      if (most >= lengths[n]) continue;
      lengths[n] = most;
      front.emplace(most, n);
    }
  }
}

} // namespace

std::vector<double> lengthsByCurvature(const SurfaceComplex& surface, const std::vector<DualEdge>& sharp,
                                       const std::function<double(const Vec3&)>& edgeLength, double chordError)
{
  const auto neighbours = neighboursOf(surface);
  const std::vector<double> ofCurves = SurfaceCurves(surface, sharp).curvatures();
  std::vector<bool> isOnCurve(surface.points.size(), false);
  for (std::size_t p = 0; p < isOnCurve.size(); ++p) isOnCurve[p] = ofCurves[p] >= 0;
  const std::vector<double> ofSurface = surfaceCurvatures(surface, neighbours, isOnCurve);
  std::vector<double> lengths;
  for (std::size_t p = 0; p < surface.points.size(); ++p)
  {
    double own = 0;
    for (const std::int32_t n : neighbours[p])
      own += norm(surface.points[n] - surface.points[p]) / double(neighbours[p].size());
    const double curvature = std::max({ ofSurface[p], ofCurves[p], 1e-12 });
    const double wanted = std::max(own, std::sqrt(6 * chordError / curvature));
    lengths.push_back(std::min(edgeLength(surface.points[p]), wanted));
  }
  limitRise(surface, neighbours, lengths);
  return lengths;
}

} // namespace surgicalmesher
