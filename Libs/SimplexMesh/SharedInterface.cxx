// SPDX-License-Identifier: Apache-2.0
#include "SharedInterface.h"

#include "EnclosedVoxels.h"
#include "MapPreparation.h"
#include "SurfaceRemeshing.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <set>

namespace surgicalmesher
{

namespace
{

TissueMap enclosedMap(const SurfaceComplex& surfaces, const Grid& grid)
{
  TissueMap map;
  map.grid = grid;
  map.labels.assign(grid.voxelCount(), 0);
  std::set<Label> tissues;
  for (const auto& [back, front] : surfaces.labels) tissues.insert(back);
  for (const Label tissue : tissues)
    for (const std::size_t voxel : enclosedVoxels(surfaces, tissue, grid)) map.labels[voxel] = tissue;
  return map;
}

using Ways = std::map<std::size_t, double>; ///< voxels with their distance from a tissue, mm

/// Calls visit(index) for the voxels of the box between two voxels.
template <class Visit>
void visitBetween(const Grid& grid, const std::array<int, 3>& a, const std::array<int, 3>& b, const Visit& visit)
{
  for (int k = std::min(a[2], b[2]); k <= std::max(a[2], b[2]); ++k)
    for (int j = std::min(a[1], b[1]); j <= std::max(a[1], b[1]); ++j)
      for (int i = std::min(a[0], b[0]); i <= std::max(a[0], b[0]); ++i) visit(grid.index(i, j, k));
}

/// Calls visit(index, step in mm) for the voxels without a tissue to which a step leads past free voxels only: a
/// diagonal step must not slip between two voxels of a thin wall.
template <class Visit>
void visitNext(const TissueMap& map, const std::vector<bool>& isFree, std::size_t voxel, const Visit& visit)
{
  const Grid& grid = map.grid;
  const auto at = grid.voxelAt(voxel);
  std::array<int, 3> low, high;
  for (int a = 0; a < 3; ++a)
  {
    low[a] = std::max(0, at[a] - 1);
    high[a] = std::min(grid.size[a] - 1, at[a] + 1);
  }
  visitBetween(grid, low, high,
               [&](std::size_t next)
               {
                 if (map.labels[next] != 0) return;
                 const auto to = grid.voxelAt(next);
                 bool isOpen = true;
                 visitBetween(grid, at, to, [&](std::size_t n) { isOpen = isOpen && isFree[n]; });
                 if (isOpen) visit(next, norm(grid.position(to[0], to[1], to[2]) - grid.position(at[0], at[1], at[2])));
               });
}

/// Returns the voxels without a tissue that paths of at most `gap` mm through free voxels reach from a tissue.
Ways waysFrom(const TissueMap& map, const std::vector<bool>& isFree, Label tissue, double gap)
{
  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  Ways ways;
  const auto leave = [&](std::size_t voxel, double way)
  {
    visitNext(map, isFree, voxel,
              [&](std::size_t next, double step)
              {
                if (way + step > gap) return;
                const auto [entry, isNew] = ways.emplace(next, way + step);
                if (!isNew && entry->second <= way + step) return;
                entry->second = way + step;
                queue.emplace(way + step, next);
              });
  };
  for (std::size_t n = 0; n < map.labels.size(); ++n)
    if (map.labels[n] == tissue) leave(n, 0);
  while (!queue.empty())
  {
    const auto [way, voxel] = queue.top();
    queue.pop();
    if (way == ways.at(voxel)) leave(voxel, way);
  }
  return ways;
}

/// Assigns each free voxel within `gap` mm of two tissues to the nearer one; ties go to the lower label. Distances are
/// those of paths through free voxels, since a straight line may cross a wall.
void closeGaps(TissueMap& map, const std::vector<bool>& isFree, double gap)
{
  struct Nearest
  {
    Label tissue;
    double way;
    bool isBetween;
  };
  std::map<std::size_t, Nearest> nearest;
  for (const Label tissue : presentLabels(map))
    for (const auto& [voxel, way] : waysFrom(map, isFree, tissue, gap))
    {
      const auto [entry, isNew] = nearest.emplace(voxel, Nearest{ tissue, way, false });
      if (isNew) continue;
      if (way < entry->second.way) entry->second = { tissue, way, true };
      entry->second.isBetween = true;
    }
  for (const auto& [voxel, near] : nearest)
    if (near.isBetween) map.labels[voxel] = near.tissue;
}

} // namespace

SurfaceComplex withSharedInterfaces(const SurfaceComplex& apart, const Grid& grid, const std::vector<bool>& isFree,
                                    double gap, const SizingFunction& edgeLength, const Progress& progress)
{
  TissueMap map = enclosedMap(apart, grid);
  closeGaps(map, isFree, gap);
  PreparationOptions preparation;
  preparation.minimumIslandVolume = std::numeric_limits<double>::max(); // a balloon is in one piece
  prepareMap(map, preparation);
  RemeshingOptions options;
  options.edgeLength = edgeLength;
  return remeshSurface(smoothedBoundary(map), options, progress).surface;
}

} // namespace surgicalmesher
