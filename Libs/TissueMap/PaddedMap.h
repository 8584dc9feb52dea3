// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A map with a margin of background around it, so that every voxel of the map has its neighbours in memory, up to the
/// width of the margin.

#include "TissueMap.h"

#include <array>
#include <cstddef>

namespace surgicalmesher
{

/// Voxel (i, j, k) of the map is voxel (i, j, k) + margin of the padded grid. The grid's origin remains the centre of
/// voxel (0, 0, 0) of the map.
struct PaddedMap : TissueMap
{
  int margin = 0; ///< voxels, on all sides

  /// Returns the voxel of the map that lies at `index` in memory; for the margin, a voxel beyond the map.
  std::array<int, 3> mapVoxelAt(std::size_t index) const
  {
    const auto [i, j, k] = grid.voxelAt(index);
    return { i - margin, j - margin, k - margin };
  }
  /// Centre of the voxel that lies at `index` in memory, in world coordinates, mm.
  Vec3 worldAt(std::size_t index) const
  {
    const auto [i, j, k] = mapVoxelAt(index);
    return grid.gridToWorld(grid.position(i, j, k));
  }
  bool isInMargin(std::size_t index) const;
};

PaddedMap padded(const TissueMap& map, int margin);

/// Copies what lies within the margin back into the map.
void copyWithoutMargin(const PaddedMap& paddedMap, TissueMap& map);

/// Memory offsets from a voxel to its 3x3x3 neighbourhood, itself included, in the order i + 3 j + 9 k; the centre is
/// at 13.
std::array<std::ptrdiff_t, 27> neighbourSteps(const Grid& grid);

/// Indices of the six face neighbours in a 3x3x3 neighbourhood.
inline constexpr std::array<int, 6> sixNeighbours{ 4, 10, 12, 14, 16, 22 };

} // namespace surgicalmesher
