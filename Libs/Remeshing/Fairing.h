// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fairing: the interface as smooth as its samples' tolerances allow, where elements are of the voxels' size and follow
/// every step of the map.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct FairingOptions
{
  double leastAngle =
    15;                  ///< degrees; a move may lower the worst angle at its vertex to this, what improves comes after
  double farthest = 0.3; ///< mm, that a vertex moves at most; nor 0.3 of its target length
  double fineLength = 1; ///< mm; beyond this target length it is farthest * (fineLength / length)^2
  int rounds = 5;
};

/// Moves every free vertex of the interface against the thin-plate energy of the umbrella vectors there: p - 0.4 U(U(p)),
/// U(x) = the mean of x at the neighbours on the same sheet or curve, less x at the vertex (Kobbelt, Campagna, Vorsatz
/// and Seidel, SIGGRAPH 1998, equation 9). Vertices where curves meet stay. Then every tissue of the block gets the
/// volume that it had, within the same reach: its boundary is offset by one length.
void fairBlock(GuardedOperations& operations, const FairingOptions& options = {});

} // namespace surgicalmesher
