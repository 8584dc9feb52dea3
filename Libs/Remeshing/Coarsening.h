// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Guarded coarsening of an ambient mesh to its target lengths.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct CoarseningOptions
{
  double shortEdge = 0.75; ///< edges shorter than this share of the target are collapsed
  double longEdge = 1.4;   ///< no collapse makes an edge longer than this share of the target
  double minimumAngle = 8; ///< degrees; no collapse leaves a worse dihedral angle (nor one above 180 minus it)
  bool fit = true;         ///< try the position that best fits the samples instead of the middle of the edge
  bool thorough = true;    ///< also try the removed vertex's position; after a collapse, visit all neighbours again
  bool quarters = true;    ///< if thorough, also try the quarter points of the edge
  double goodAngle = 20;   ///< degrees; a collapse that leaves no worse dihedral angle is accepted at once
};

/// Makes one pass over a block at size level `level` (mm), L being the target length: collapses vertices with an edge
/// shorter than shortEdge * min(level, L) onto a neighbour, roughly in the order of increasing relative edge length.
void coarsenBlock(GuardedOperations& operations, double level, const CoarseningOptions& options);

} // namespace surgicalmesher
