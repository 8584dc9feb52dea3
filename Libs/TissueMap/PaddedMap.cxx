// SPDX-License-Identifier: Apache-2.0
#include "PaddedMap.h"

#include <algorithm>

namespace surgicalmesher
{

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
  for (int k = 0; k < map.grid.size[2]; ++k)
  {
    for (int j = 0; j < map.grid.size[1]; ++j)
    {
      const Label* row = map.labels.data() + map.grid.index(0, j, k);
      std::copy(row, row + map.grid.size[0], result.labels.data() + result.grid.index(margin, j + margin, k + margin));
    }
  }
  return result;
}

void copyWithoutMargin(const PaddedMap& paddedMap, TissueMap& map)
{
  const int margin = paddedMap.margin;
  for (int k = 0; k < map.grid.size[2]; ++k)
  {
    for (int j = 0; j < map.grid.size[1]; ++j)
    {
      const Label* row = paddedMap.labels.data() + paddedMap.grid.index(margin, j + margin, k + margin);
      std::copy(row, row + map.grid.size[0], map.labels.data() + map.grid.index(0, j, k));
    }
  }
}

std::array<std::ptrdiff_t, 27> neighbourSteps(const Grid& grid)
{
  const std::ptrdiff_t j = grid.size[0], k = j * grid.size[1];
  std::array<std::ptrdiff_t, 27> steps;
  for (int n = 0; n < 27; ++n) steps[n] = (n % 3 - 1) + (n / 3 % 3 - 1) * j + (n / 9 - 1) * k;
  return steps;
}

} // namespace surgicalmesher
