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
  bool fit = true;         ///< try the position that fits the samples best instead of an edge's middle
  bool thorough = true;    ///< try more places for the two, and all neighbours again after each collapse
  bool quarters = true;    ///< and, if thorough, the quarter points of the edge
  double goodAngle = 20;   ///< degrees; a collapse that keeps this much is taken at once
};

/// One pass over a block at size level `level` (mm): vertices with an edge shorter than shortEdge * min(level, L) are
/// collapsed onto a neighbour, shortest relative edge first.
void coarsenBlock(GuardedOperations& operations, double level, const CoarseningOptions& options);

} // namespace surgicalmesher
