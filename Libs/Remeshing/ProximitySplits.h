// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Refinement driven by proximity (Delingette's operator T2): splits interface edges where the interface is too far
/// from its samples.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct ProximityOptions
{
  double leastAngle = 12; ///< degrees; dihedral angles that moves and splits may leave
  double shortest = 0.6;  ///< mm; shorter edges are not split
  int rounds = 2;
};

/// For each interface face that is farther from one of its samples than the sample's tolerance: moves the face's
/// vertices to the least-squares fit to their samples; if a sample is still too far, splits the face's longest edge and
/// moves the new vertex to its fit. The split is undone unless it lowers the worst ratio of squared distance to squared
/// tolerance by at least a tenth.
void meetProximityOfBlock(GuardedOperations& operations, const ProximityOptions& options = {});

} // namespace surgicalmesher
