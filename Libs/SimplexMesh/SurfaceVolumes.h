// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Volumes of the tissues enclosed by a surface, and displacements of its points that change these volumes.

#include "TetMesh.h"

#include <map>

namespace surgicalmesher
{

/// Returns the enclosed volume, mm^3, of every label except 0.
std::map<Label, double> enclosedVolumes(const SurfaceComplex& surface);

/// Returns displacements of the points by which every tissue gains the volume in `lacking` (mm^3), to first order. Of
/// all such displacements, they have the least mean square over the area of the surface, found with Lagrange
/// multipliers: a pressure in each tissue. `mobility` scales the displacement of each point: 0 fixes it, 1 moves it
/// according to its area. Volume changes that the mobile points cannot produce are left out.
std::vector<Vec3> displacementsForVolumes(const SurfaceComplex& surface, const std::map<Label, double>& lacking,
                                          const std::vector<double>& mobility);

} // namespace surgicalmesher
