// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Maps resampled to smaller voxels by nearest neighbours.

#include "RepeatedVoxels.h"

namespace surgicalmesher::test
{

/// Describes the map in which each voxel of `map` is repeated `times` times along every axis, in its place, with
/// `before` and `after` more voxels of background at the lower and upper ends.
inline VoxelRepeats repeatsOf(const TissueMap& map, int times, const std::array<int, 3>& before = {},
                              const std::array<int, 3>& after = {})
{
  VoxelRepeats repeats{ map.grid, times, before };
  repeats.grid.spacing = map.grid.spacing / double(times);
  Vec3 first; // centre of the new voxel (0, 0, 0), in the grid frame of the map
  for (int a = 0; a < 3; ++a)
  {
    repeats.grid.size[a] = map.grid.size[a] * times + before[a] + after[a];
    first[a] = -(before[a] + 0.5 * (times - 1)) * repeats.grid.spacing[a];
  }
  repeats.grid.origin = map.grid.gridToWorld(first);
  return repeats;
}

} // namespace surgicalmesher::test
