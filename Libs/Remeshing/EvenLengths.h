// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Lengths of the edges between labels, evened out without another vertex: where coarsening can take no more away, or
/// has taken too much, edges are too short or too long beside others with room to spare.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

/// What counts as even, in shares of the target length, a little within the usual 0.7 to 1.4.
constexpr double shortestEven = 0.71, longestEven = 1.39;
constexpr double insideLabel = 0.2; ///< what an edge inside a label counts beside one between labels

struct EdgeLengthOptions
{
  double goodAngle = usualAngle; ///< degrees; a move that lowers the worst angle at its vertex is taken only above this
  double from = 0;               ///< mm; vertices with smaller target lengths stay
  double robust = 0;             ///< mm, see quadricOf
};

/// Moves vertices between labels along their sheets and curves to where more of their edges have even lengths. Then
/// they go to the fit of their faces to their samples, where that costs none of these lengths.
void evenLengthsOfBlock(GuardedOperations& operations, const EdgeLengthOptions& options = {});

} // namespace surgicalmesher
