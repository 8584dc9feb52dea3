// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An image of one number per voxel, as a scanner gives it.

#include "Grid.h"

#include <vector>

namespace surgicalmesher
{

struct ScalarImage
{
  Grid grid;                 ///< axes permuted and flipped to run along +L, +P, +S as nearly as they can
  std::vector<float> values; ///< grid.voxelCount() finite values, i fastest
};

} // namespace surgicalmesher
