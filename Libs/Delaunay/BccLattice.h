// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the vertices between the surfaces begin.
///
/// Fuchs (as used by Audette et al., Computer Aided Surgery 12(1), 2007) starts from a partition of space into
/// congruent canonical tetrahedra, with x1 = 1/3: four edges of length 1 and two of 2 / sqrt(3), dihedral angles 4 x 60
/// and 2 x 90 degrees, 24 tetrahedra around every vertex, invariant under subdivision. Its vertices are those of the
/// body-centred cubic lattice with cubes of edge 2 / sqrt(3), whose Delaunay tetrahedra it is. The density function
/// rho(x) becomes an octree of such cubes: subdivision by 2 takes the lattice into itself. Each place has the octave
/// nearest to L(x), and the phase of the octaves is the place of log L where most of the vertices are.

#include "SizingFunction.h"
#include "TetMesh.h"

namespace surgicalmesher
{

/// Mean edge of the lattice's tetrahedra, over the cube's edge: 8 edges sqrt(3)/2 and 6 edges 1 at every vertex.
constexpr double kLatticeMeanEdge = (8 * 0.86602540378443865 + 6) / 14;

/// Lattice points in a box around the surface, its corners included: in the tissues with the density of L(x), outside
/// ever sparser with the distance. All are at least `clearance` * L(x) away from the surface: closer ones make flat
/// elements on it, farther ones long elements.
/// Deterministic, whatever the number of threads. Throws InputError unless L(x) is positive and finite.
std::vector<Vec3> latticePoints(const SurfaceComplex& surface, const SizingFunction& edgeLength,
                                double clearance = 0.4);

} // namespace surgicalmesher
