// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A map with a margin of background around it: every voxel of the map then has all its neighbours in memory.

#include "TissueMap.h"

#include <array>
#include <cstddef>

namespace surgicalmesher
{

/// A copy of the map with `margin` voxels of background on all sides; voxel (i, j, k) becomes (i, j, k) + margin. The
/// grid's origin stays that of the map.
TissueMap padded(const TissueMap& map, int margin);

/// Copies what a padded copy holds within its margin back into the map.
void copyWithoutMargin(const TissueMap& paddedMap, int margin, TissueMap& map);

/// Steps from a voxel to its 3x3x3 neighbourhood, itself included, in memory order: i + 3 j + 9 k, the centre at 13.
std::array<std::ptrdiff_t, 27> neighbourSteps(const Grid& grid);

/// Places of the six face neighbours in a 3x3x3 neighbourhood.
inline constexpr std::array<int, 6> sixNeighbours{ 4, 10, 12, 14, 16, 22 };

} // namespace surgicalmesher
