// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Edge swaps for all angles, not the worst alone: what improvement of the worst tetrahedra leaves mediocre, other edges
/// between the same vertices often make good.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct SwapOptions
{
  double goodAngle = usualAngle; ///< degrees; a swap may lower the worst angle around its edge to this
  double smoothness = 3; ///< what a radian of bending along an edge of the target length counts beside the sine of an
                         ///< angle
  bool sparesWhole = false; ///< keep the tetrahedra of vertices that are the lattice's: see isWhole
};

/// Removes each edge whose tetrahedra others with a larger sum of sines, above the usual one, can replace; between two
/// labels, the edge flips for smaller angles between its sheet's triangles as well.
void swapEdgesOfBlock(GuardedOperations& operations, const SwapOptions& options = {});

} // namespace surgicalmesher
