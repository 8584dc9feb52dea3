// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Moves of the interface by whole tetrahedra, which leave every tetrahedron's shape as it is: for places where
/// vertices are held back by the angles that they would spoil.

#include "GuardedOperations.h"

namespace surgicalmesher
{

/// Gives tetrahedra with two or three faces towards one other label to that, where dihedral angles of `keptAngle`
/// (degrees) remain and `mostLeft` of what there is between the surface and its samples (GuardedOperations::relabel) at
/// most.
void relabelBlock(GuardedOperations& operations, double keptAngle, double mostLeft);

} // namespace surgicalmesher
