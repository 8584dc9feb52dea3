// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Initial positions of the vertices between the surfaces.
///
/// Fuchs (as used by Audette et al., Computer Aided Surgery 12(1), 2007) starts from a partition of space into
/// congruent canonical tetrahedra, with x1 = 1/3: four edges of length 1 and two of 2 / sqrt(3), dihedral angles 4 x 60
/// and 2 x 90 degrees, 24 tetrahedra around every vertex, invariant under subdivision. These are the Delaunay
/// tetrahedra of the body-centred cubic lattice with cubes of edge 2 / sqrt(3). The density function rho(x) is realised
/// as an octree of such cubes, since subdivision by 2 maps the lattice into itself. Every place uses the octave nearest
/// to L(x); the phase of the octaves is chosen to fit log L at most of the vertices.

#include "SizingFunction.h"
#include "TetMesh.h"

namespace surgicalmesher
{

/// Mean edge length of the lattice's tetrahedra relative to the edge of the cube: every vertex has 8 edges of length
/// sqrt(3)/2 and 6 of length 1.
constexpr double kLatticeMeanEdge = (8 * 0.86602540378443865 + 6) / 14;

/// Returns lattice points in a box around the surface, including the corners of the box: with the density of L(x)
/// inside the tissues, and increasingly sparse with the distance outside. All points are at least `clearance` * L(x)
/// away from the surface: closer points would create flat elements, more distant ones long elements.
///
/// The result does not depend on the number of threads. Throws InputError unless L(x) is positive and finite.
std::vector<Vec3> latticePoints(const SurfaceComplex& surface, const SizingFunction& edgeLength,
                                double clearance = 0.4);

} // namespace surgicalmesher
