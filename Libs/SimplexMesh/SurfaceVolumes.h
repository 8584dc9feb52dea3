// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Volumes of the tissues that a surface encloses, and how to move its points for them to be others.

#include "TetMesh.h"

#include <map>

namespace surgicalmesher
{

/// mm^3, of all labels but 0.
std::map<Label, double> enclosedVolumes(const SurfaceComplex& surface);

/// Displacements of the points by which every tissue gains what `lacking` says (mm^3), to first order: of all such the
/// least, in the mean square over the surface's area, by Lagrange's multipliers: a pressure in each tissue. A point
/// moves as readily as `mobility` says: 0, it stays; 1, as its area does. What cannot be gained is not.
std::vector<Vec3> displacementsForVolumes(const SurfaceComplex& surface, const std::map<Label, double>& lacking,
                                          const std::vector<double>& mobility);

} // namespace surgicalmesher
