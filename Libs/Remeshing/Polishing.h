// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Polishing: moves vertices towards their boundary samples, then uphill in the sum of the sines of the worst dihedral
/// angles of their tetrahedra.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct PolishingOptions
{
  double goodAngle = 29.5;  ///< degrees; as in RelaxationOptions
  double fit = 1;           ///< weight of the samples against a spring to the vertex's present position
  double robust = 0;        ///< mm, see quadricOf
  double leastWay = 0;      ///< mm; a vertex nearer than this to its fitted position is not moved to it
  bool climbs = true;       ///< whether vertices move uphill in the sum of sines after the fit
  bool sparesWhole = false; ///< leave vertices alone whose star still looks as in the lattice, see isWhole
  double ease = 0.02;       ///< how easily a vertex leaves its samples for better angles: 0 not at all, 1 freely
};

/// Visits every unlocked vertex once. Moves an interface vertex to the least-squares fit of its faces to their samples.
/// Then moves the vertex uphill in the sum of the sines of the worst dihedral angles in its star; interface vertices
/// prefer directions along their sheets and curves.
void polishBlock(GuardedOperations& operations, const PolishingOptions& options = {});

} // namespace surgicalmesher
