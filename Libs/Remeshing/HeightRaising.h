// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Raises the least heights of tetrahedra, which bound the time step of an explicit solver, whatever their angles.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct HeightOptions
{
  /// mm; tetrahedra of tissues whose least height is smaller are processed, but at most the lowest 3 % of each tissue:
  /// a tissue with more low tetrahedra is thin itself.
  double height = 0;
  double goodAngle = 28.6;   ///< degrees; no dihedral angle falls below this, or falls further if it is below already
  double longEdge = 1.4;     ///< a collapse creates no edge longer than this multiple of its target length
  int trials = 40;           ///< positions tried for each vertex
  double worstShare = 0.005; ///< share of the tetrahedra processed in one pass, lowest first; at least 100 of them
  int passes = 16;
};

/// Processes low tetrahedra, lowest first: collapses an edge, removes an edge, or moves the vertices, where
/// that raises the least height among the affected tetrahedra of tissues. Interface vertices move as far as the
/// envelope allows; those with only three interface triangles do not move.
void raiseHeightsOfBlock(GuardedOperations& operations, const HeightOptions& options);

} // namespace surgicalmesher
