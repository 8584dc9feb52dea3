// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Return of single vertices to the boundary: of those that collapses and repairs have left off it, and whose
/// tetrahedra prevent a direct move.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct VertexReturnOptions
{
  double goodAngle = usualAngle; ///< degrees; the worst dihedral angle around a vertex may fall to this
  double leastWay = 0;           ///< mm; a vertex nearer than this to its fitted position is not moved
  double leastShare = 0;         ///< the same as a share of the target length; the larger of the two counts
  double robust = 0;             ///< mm, see quadricOf
  double foldsFrom = 0;          ///< mm; where the target length is smaller, a return may add folds to the interface
};

/// Moves each unlocked interface vertex that is too far from the least-squares fit to its samples to this fit, or a
/// part of the way, at the cost of bad angles but not of inverted tetrahedra. Then the vertex and its neighbours move
/// together within the envelope until the worst angle is good or as good as before. If it does not become so, or if
/// more of the interface is folded, all these moves are undone.
void returnVerticesOfBlock(GuardedOperations& operations, const VertexReturnOptions& options);

} // namespace surgicalmesher
