// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Maps resampled to smaller voxels by nearest neighbours.

#include "RepeatedVoxels.h"

namespace surgicalmesher::test
{

/// The voxels of a map, each `times` times along every axis in its place, between `before` and `after` more voxels of
/// background.
inline VoxelRepeats repeatsOf(const TissueMap& map, int times, const std::array<int, 3>& before = {},
                              const std::array<int, 3>& after = {})
{
  VoxelRepeats repeats{ map.grid, times, before };
  repeats.grid.spacing = map.grid.spacing / double(times);
  Vec3 first; // of the repeated voxels, seen from the middle of the map's
  for (int a = 0; a < 3; ++a)
  {
    repeats.grid.size[a] = map.grid.size[a] * times + before[a] + after[a];
    first[a] = -(before[a] + 0.5 * (times - 1)) * repeats.grid.spacing[a];
  }
  repeats.grid.origin = map.grid.gridToWorld(first);
  return repeats;
}

} // namespace surgicalmesher::test
