// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Evens out the lengths of interface edges by moving vertices: where coarsening can remove no more vertices, or has
/// removed too many, edges are too short or too long next to others with room to spare.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

/// Range of even edge lengths, in target lengths; a little within the usual 0.7 to 1.4.
constexpr double shortestEven = 0.71, longestEven = 1.39;
constexpr double insideLabel = 0.2; ///< weight of an edge inside a label, relative to an interface edge

struct EdgeLengthOptions
{
  double goodAngle = usualAngle; ///< degrees; a move may lower the worst angle at its vertex to this
  double from = 0;               ///< mm; vertices with smaller target lengths stay
  double robust = 0;             ///< mm, see quadricOf
};

/// Moves interface vertices along their sheets and curves to where more of their edges have even lengths. Then moves
/// them and their interface neighbours to the least-squares fit to their samples, where that costs no even length.
void evenLengthsOfBlock(GuardedOperations& operations, const EdgeLengthOptions& options = {});

} // namespace surgicalmesher
