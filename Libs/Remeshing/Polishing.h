// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Polishing: every vertex to its boundary samples, and up the sum of the sines of the worst dihedral angles.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct PolishingOptions
{
  double goodAngle = 29.5;  ///< degrees; as in RelaxationOptions
  double fit = 1;           ///< weight of the samples against staying
  double robust = 0;        ///< mm, see quadricOf
  double leastWay = 0;      ///< mm, to the fit; a vertex that is nearer to it stays there
  bool climbs = true;       ///< up the sum of the sines, after the fit
  bool sparesWhole = false; ///< leave vertices alone whose tetrahedra are the lattice's: see isWhole
  double ease = 0.02;       ///< how easily a vertex leaves its samples for better angles: 0 not at all, 1 freely
};

/// Moves every free vertex once to the least-squares fit of its faces to their samples, and then once up the sum of the
/// sines of the worst angles at it, on the interface along sheets and curves rather than across.
void polishBlock(GuardedOperations& operations, const PolishingOptions& options = {});

} // namespace surgicalmesher
