// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Edge swaps that improve all angles, not the worst alone: tetrahedra that the improvement of the worst ones leaves
/// mediocre often become good with other edges between the same vertices.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct SwapOptions
{
  double goodAngle = usualAngle; ///< degrees; a swap may lower the worst angle around its edge to this
  double smoothness = 3;         ///< weight, in sines, of a radian of bending along an edge of the target length
  bool sparesWhole = false;      ///< keep the tetrahedra of vertices whose star is that of the lattice (isWhole)
};

/// Removes edges of mediocre tetrahedra, and edges of the interface, if that increases the sum, over the tetrahedra, of
/// the sine of the worst dihedral angle less the usual sine. An edge of the interface is flipped within its sheet,
/// where smaller angles between the triangles count as well (GuardedOperations::swapEdge).
void swapEdgesOfBlock(GuardedOperations& operations, const SwapOptions& options = {});

} // namespace surgicalmesher
