// SPDX-License-Identifier: Apache-2.0
#include "SharedInterface.h"

#include "EnclosedVoxels.h"
#include "MapPreparation.h"
#include "SurfaceRemeshing.h"

#include <limits>
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

/// Calls visit(index, distance in mm) for the voxels within `reach` mm of a voxel.
template <class Visit>
void visitAround(const Grid& grid, std::size_t voxel, double reach, const Visit& visit)
{
  const auto at = grid.voxelAt(voxel);
  std::array<int, 3> low, high;
  for (int a = 0; a < 3; ++a)
  {
    const int window = int(reach / grid.spacing[a]);
    low[a] = std::max(0, at[a] - window);
    high[a] = std::min(grid.size[a] - 1, at[a] + window);
  }
  const Vec3 centre = grid.position(at[0], at[1], at[2]);
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i)
        if (const double way = norm(grid.position(i, j, k) - centre); way <= reach) visit(grid.index(i, j, k), way);
}

/// Assigns each free voxel within `gap` mm of two tissues to the nearer one; ties go to the lower label.
void closeGaps(TissueMap& map, const std::vector<bool>& isFree, double gap)
{
  struct Near
  {
    std::map<Label, double> ways;
  };
  std::map<std::size_t, Near> between;
  for (std::size_t n = 0; n < map.labels.size(); ++n)
  {
    const Label label = map.labels[n];
    if (label == 0) continue;
    bool isInside = true;
    visitAround(map.grid, n, 1.01 * map.grid.largestSpacing(),
                [&](std::size_t m, double) { isInside &= map.labels[m] == label; });
    if (isInside) continue;
    visitAround(map.grid, n, gap,
                [&](std::size_t m, double way)
                {
                  if (map.labels[m] != 0 || !isFree[m]) return;
                  auto [entry, isNew] = between[m].ways.emplace(label, way);
                  entry->second = std::min(entry->second, way);
                });
  }
  for (const auto& [voxel, near] : between)
  {
    if (near.ways.size() < 2) continue;
    const auto nearest = std::min_element(near.ways.begin(), near.ways.end(),
                                          [](const auto& x, const auto& y) { return x.second < y.second; });
    map.labels[voxel] = nearest->first;
  }
}

} // namespace

SurfaceComplex withSharedInterfaces(const SurfaceComplex& apart, const Grid& grid, const std::vector<bool>& isFree,
                                    double gap, const SizingFunction& edgeLength, const Progress& progress)
{
  TissueMap map = enclosedMap(apart, grid);
  closeGaps(map, isFree, gap);
  prepareMap(map, {});
  RemeshingOptions options;
  options.edgeLength = edgeLength;
  return remeshSurface(smoothedBoundary(map), options, progress).surface;
}

} // namespace surgicalmesher
