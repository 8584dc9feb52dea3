// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Smooths the voxel staircase of the tissue boundaries without shrinking them.

#include "KuhnLattice.h"

namespace surgicalmesher
{

struct SmoothingOptions
{
  int iterations = 12;      ///< pairs of a shrinking and a growing step
  double shrink = 0.5;      ///< lambda of G. Taubin (SIGGRAPH 1995)
  double grow = -0.53;      ///< mu of the same
  double box = 0.5;         ///< largest displacement of a vertex along each axis, as a share of the voxel spacing
  double samples = 0.45;    ///< boundary samples follow the surface by this share of its displacement
  double minimumAngle = 10; ///< degrees; moves that would leave a worse dihedral angle are shortened
};

/// Moves the interface vertices of a new lattice, and their boundary samples, to the smoothed boundary. A vertex on a
/// curve between three or more labels is averaged with its neighbours on the curve only; where such curves meet or end,
/// vertices do not move. `voxelSpacing` in mm, along each axis.
void smoothInterface(KuhnLattice& lattice, const Vec3& voxelSpacing, const SmoothingOptions& options = {});

/// Moves each of `vertices` towards its `target`, as far as no dihedral angle falls below `minimumAngle` (degrees). The
/// result does not depend on the order of the vertices.
void moveVertices(TetMesh& mesh, const std::vector<std::int32_t>& vertices, const std::vector<Vec3>& target,
                  double minimumAngle);

} // namespace surgicalmesher
