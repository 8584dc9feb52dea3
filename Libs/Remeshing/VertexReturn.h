// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Return of single vertices that collapses and repairs have left off the boundary, where tetrahedra hold them there.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct VertexReturnOptions
{
  double goodAngle = usualAngle; ///< degrees; a worst angle around a vertex may fall to this
  double leastWay = 0;           ///< mm, to the fit; a vertex that is nearer to it stays there
  double leastShare = 0;         ///< the same in target lengths, whichever is more
  double robust = 0;             ///< mm, see quadricOf
  double foldsFrom = 0;          ///< mm; where target lengths are smaller, a return may fold more of the interface
};

/// Moves each free vertex of the interface that is too far from the least-squares fit to its samples all the way to it,
/// or a part of the way, over bad angles but not over inverted tetrahedra. Then it and its neighbours move together, as
/// the envelope lets them, until angles are what they were or good; if they do not come to be, or more is folded, all of
/// that is taken back.
void returnVerticesOfBlock(GuardedOperations& operations, const VertexReturnOptions& options);

} // namespace surgicalmesher
