// SPDX-License-Identifier: Apache-2.0
#include "MinimalPath.h"

#include "Errors.h"
#include "ItkImage.h"
#include "Place.h"
#include "Sampling.h"

#include <itkFastMarchingImageFilterBase.h>
#include <itkFastMarchingReachedTargetNodesStoppingCriterion.h>

#include <algorithm>
#include <limits>

namespace surgicalmesher
{

namespace
{

using Image = ItkImage;
using Marching = itk::FastMarchingImageFilterBase<Image, Image>;
using Criterion = itk::FastMarchingReachedTargetNodesStoppingCriterion<Image, Image>;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The eight voxels around a position, or fewer at the border.
std::vector<std::array<int, 3>> voxelsAround(const Grid& grid, const Vec3& p)
{
  const Vec3 index = toIndex(grid, p);
  std::array<std::array<int, 2>, 3> range;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int low = std::clamp(int(std::floor(index[axis])), 0, grid.size[axis] - 1);
    range[axis] = { low, std::min(low + 1, grid.size[axis] - 1) };
  }
  std::vector<std::array<int, 3>> voxels;
  for (int k = range[2][0]; k <= range[2][1]; ++k)
    for (int j = range[1][0]; j <= range[1][1]; ++j)
      for (int i = range[0][0]; i <= range[0][1]; ++i) voxels.push_back({ i, j, k });
  return voxels;
}

Image::IndexType asItkIndex(const std::array<int, 3>& voxel) { return { { voxel[0], voxel[1], voxel[2] } }; }

/// Arrival time, at most `wall`: to the descent, voxels that the front has not reached are a wall of that height.
float finiteTime(const std::vector<float>& times, std::size_t n, float wall) { return std::min(times[n], wall); }

/// Gradient of the trilinear interpolant of T, with `wall` in place of infinite times.
Vec3 timeGradient(const Grid& grid, const std::vector<float>& times, const Vec3& p, float wall)
{
  const Vec3 index = toIndex(grid, p);
  std::array<int, 3> low;
  Vec3 t;
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = std::clamp(int(std::floor(index[axis])), 0, std::max(grid.size[axis] - 2, 0));
    t[axis] = std::clamp(index[axis] - low[axis], 0.0, 1.0);
  }
  Vec3 gradient;
  for (int corner = 0; corner < 8; ++corner)
  {
    std::array<int, 3> voxel;
    Vec3 weight;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool upper = (corner >> axis) & 1;
      voxel[axis] = std::min(low[axis] + upper, grid.size[axis] - 1);
      weight[axis] = upper ? t[axis] : 1 - t[axis];
    }
    const double time = finiteTime(times, grid.index(voxel[0], voxel[1], voxel[2]), wall);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double sign = ((corner >> axis) & 1) ? 1 : -1;
      const double others = weight[(axis + 1) % 3] * weight[(axis + 2) % 3];
      gradient[axis] += sign * others * time / grid.spacing[axis];
    }
  }
  return gradient;
}

/// Returns the neighbour of least time, for places where the interpolated gradient does not lead downwards.
std::array<int, 3> lowestNeighbour(const Grid& grid, const std::vector<float>& times, const std::array<int, 3>& voxel)
{
  std::array<int, 3> best = voxel;
  for (int n = 0; n < 27; ++n)
  {
    const std::array<int, 3> other{ voxel[0] + n % 3 - 1, voxel[1] + n / 3 % 3 - 1, voxel[2] + n / 9 - 1 };
    if (!grid.contains(other[0], other[1], other[2])) continue;
    const auto timeOf = [&](const std::array<int, 3>& v) { return times[grid.index(v[0], v[1], v[2])]; };
    if (timeOf(other) < timeOf(best)) best = other;
  }
  return best;
}

/// Largest finite time among the voxels within two of p.
float wallAround(const Grid& grid, const std::vector<float>& times, const Vec3& p)
{
  const std::array<int, 3> centre = nearestVoxel(grid, p);
  float wall = 0;
  for (int n = 0; n < 125; ++n)
  {
    const int i = centre[0] + n % 5 - 2;
    const int j = centre[1] + n / 5 % 5 - 2;
    const int k = centre[2] + n / 25 - 2;
    if (!grid.contains(i, j, k)) continue;
    const float time = times[grid.index(i, j, k)];
    if (time < infinity) wall = std::max(wall, time);
  }
  return wall;
}

} // namespace

std::vector<float> arrivalTimes(const Grid& grid, const std::vector<float>& speed, const Vec3& source,
                                const Vec3& target)
{
  const auto trial = Marching::NodePairContainerType::New();
  for (const std::array<int, 3>& voxel : voxelsAround(grid, source))
  {
    const float here = speed[grid.index(voxel[0], voxel[1], voxel[2])];
    if (!(here > 0)) continue;
    trial->push_back({ asItkIndex(voxel), float(norm(voxelCentre(grid, voxel) - source) / here) });
  }
  std::vector<float> times(grid.voxelCount(), infinity);
  std::vector<Image::IndexType> targets;
  for (const std::array<int, 3>& voxel : voxelsAround(grid, target))
  {
    if (speed[grid.index(voxel[0], voxel[1], voxel[2])] > 0) targets.push_back(asItkIndex(voxel));
  }
  if (trial->empty() || targets.empty()) return times;
  const auto forbidden = Marching::NodePairContainerType::New();
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
      {
        if (!(speed[grid.index(i, j, k)] > 0)) forbidden->push_back({ asItkIndex({ i, j, k }), 0 });
      }
  const auto criterion = Criterion::New();
  criterion->SetTargetCondition(Criterion::AllTargets);
  criterion->SetTargetNodes(targets);
  const auto marching = Marching::New();
  marching->SetInput(asItkImage<Image>(inGridFrame(grid), speed));
  marching->SetTrialPoints(trial);
  marching->SetForbiddenPoints(forbidden);
  marching->SetStoppingCriterion(criterion);
  marching->Update();
  const float* reached = marching->GetOutput()->GetBufferPointer();
  for (std::size_t n = 0; n < times.size(); ++n)
  {
    if (speed[n] > 0 && reached[n] < std::numeric_limits<float>::max() / 4) times[n] = reached[n];
  }
  return times;
}

std::vector<Vec3> minimalPath(const Grid& grid, const std::vector<float>& speed, const Vec3& source, const Vec3& target)
{
  const std::vector<float> times = arrivalTimes(grid, speed, source, target);
  const std::array<int, 3> last = nearestVoxel(grid, target);
  if (!(times[grid.index(last[0], last[1], last[2])] < infinity))
    throw InputError("--block: every way from " + place(grid.gridToWorld(source)) + " to " +
                     place(grid.gridToWorld(target)) +
                     " LPS is blocked, expected one outside the tubes to keep out of");
  const double step = voxelLength(grid) / 3;
  const double closeEnough = voxelLength(grid);
  const std::size_t limit = 200 * (std::size_t(grid.size[0]) + grid.size[1] + grid.size[2]);
  std::vector<Vec3> path{ target };
  Vec3 p = target;
  while (norm(p - source) > closeEnough)
  {
    const float wall = wallAround(grid, times, p);
    const auto timeAt = [&](const Vec3& q)
    {
      double time = 0;
      const std::vector<std::array<int, 3>> around = voxelsAround(grid, q);
      const Vec3 index = toIndex(grid, q);
      for (const std::array<int, 3>& v : around)
      {
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) weight *= std::max(0.0, 1 - std::abs(index[axis] - v[axis]));
        time += weight * finiteTime(times, grid.index(v[0], v[1], v[2]), wall);
      }
      return time;
    };
    const Vec3 gradient = timeGradient(grid, times, p, wall);
    const double slope = norm(gradient);
    Vec3 next = slope > 0 ? p - (step / slope) * gradient : p;
    if (!(timeAt(next) < timeAt(p)))
    {
      const std::array<int, 3> voxel = nearestVoxel(grid, p);
      const std::array<int, 3> lower = lowestNeighbour(grid, times, voxel);
      next = voxelCentre(grid, lower);
      if (lower == voxel && norm(next - p) < 1e-9) break;
    }
    p = next;
    path.push_back(p);
    if (path.size() > limit) throw EngineError("minimal path: the descent does not come to an end");
  }
  path.push_back(source);
  std::reverse(path.begin(), path.end());
  return path;
}

} // namespace surgicalmesher
