// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Heights of the flattest and smallest tetrahedra, which set an explicit solver's step, whatever their angles.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct HeightOptions
{
  double height = 0;       ///< mm; tetrahedra of tissues with a smaller height than this are worked on, of each tissue
                           ///< three in a hundred at most: where more are low, the tissue is thin
  double goodAngle = 28.6; ///< degrees; no dihedral angle falls below this, or falls if it is below
  double longEdge = 1.4;   ///< collapses leave no edge longer than this share of its target
  int trials = 40;         ///< positions tried for each vertex
  double worstShare = 0.005; ///< of the tetrahedra, the lowest, that are worked on in one pass; a hundred at least
  int passes = 16;
};

/// Lowest first: merges one end of a short edge into the other, removes an edge, or moves vertices, where that raises the
/// least height of all tetrahedra of tissues that change. Vertices of the interface move as far as the envelope allows,
/// but those with three triangles stay.
void raiseHeightsOfBlock(GuardedOperations& operations, const HeightOptions& options);

} // namespace surgicalmesher
