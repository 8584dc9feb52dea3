// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Moves the interface by relabelling whole tetrahedra, which leaves their shapes unchanged. For places where vertices
/// cannot move without spoiling dihedral angles.

#include "GuardedOperations.h"

namespace surgicalmesher
{

/// Relabels tetrahedra that have two or three faces towards one other label to that label, where quality stays above
/// that of `keptAngle` (degrees) and at most the share `mostLeft` of the squared distances between the surface and its
/// samples remains (see GuardedOperations::relabel).
void relabelBlock(GuardedOperations& operations, double keptAngle, double mostLeft);

} // namespace surgicalmesher
