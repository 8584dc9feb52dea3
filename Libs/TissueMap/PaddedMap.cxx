// SPDX-License-Identifier: Apache-2.0
#include "PaddedMap.h"

#include "Parallel.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

/// Calls f(first voxel in the map, first voxel in the padded map) for every row of the map, on all threads; the
/// arguments are memory indices.
template <class F>
void forEachRow(const TissueMap& map, const PaddedMap& paddedMap, F&& f)
{
  const int margin = paddedMap.margin;
  parallelFor(std::size_t(map.grid.size[2]),
              [&](std::size_t slice)
              {
                const int k = int(slice);
                for (int j = 0; j < map.grid.size[1]; ++j)
                  f(map.grid.index(0, j, k), paddedMap.grid.index(margin, j + margin, k + margin));
              });
}

} // namespace

bool PaddedMap::isInMargin(std::size_t index) const
{
  const auto voxel = grid.voxelAt(index);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (voxel[axis] < margin || voxel[axis] >= grid.size[axis] - margin) return true;
  }
  return false;
}

PaddedMap padded(const TissueMap& map, int margin)
{
  PaddedMap result;
  result.grid = map.grid;
  result.margin = margin;
  for (int& size : result.grid.size) size += 2 * margin;
  result.labels.assign(result.grid.voxelCount(), 0);
  forEachRow(map, result,
             [&](std::size_t inMap, std::size_t inPadded)
             {
               const Label* row = map.labels.data() + inMap;
               std::copy(row, row + map.grid.size[0], result.labels.data() + inPadded);
             });
  return result;
}

void copyWithoutMargin(const PaddedMap& paddedMap, TissueMap& map)
{
  forEachRow(map, paddedMap,
             [&](std::size_t inMap, std::size_t inPadded)
             {
               const Label* row = paddedMap.labels.data() + inPadded;
               std::copy(row, row + map.grid.size[0], map.labels.data() + inMap);
             });
}

std::array<std::ptrdiff_t, 27> neighbourSteps(const Grid& grid)
{
  const std::ptrdiff_t j = grid.size[0], k = j * grid.size[1];
  std::array<std::ptrdiff_t, 27> steps;
  for (int n = 0; n < 27; ++n) steps[n] = (n % 3 - 1) + (n / 3 % 3 - 1) * j + (n / 9 - 1) * k;
  return steps;
}

} // namespace surgicalmesher
