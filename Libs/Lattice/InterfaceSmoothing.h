// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sub-voxel position of the tissue boundaries: the voxels' staircase, smoothed without shrinking.

#include "KuhnLattice.h"

namespace surgicalmesher
{

struct SmoothingOptions
{
  int iterations = 12;      ///< pairs of a shrinking and a growing step
  double shrink = 0.5;      ///< lambda of G. Taubin (SIGGRAPH 1995)
  double grow = -0.53;      ///< mu
  double box = 0.5;         ///< no vertex leaves its place by more than this share of the voxel along any axis
  double samples = 0.45;    ///< share of the way that boundary samples go along with the surface
  double minimumAngle = 10; ///< degrees; moves that would leave a worse dihedral angle are shortened
};

/// Moves the interface vertices of a fresh lattice to the smoothed boundary. Vertices on a curve between three or more
/// labels move along their neighbours on such curves; where curves meet, and on the border, they stay.
void smoothInterface(KuhnLattice& lattice, const Vec3& voxelSpacing, const SmoothingOptions& options = {});

/// Moves each of `vertices` as far towards its `target` as leaves no dihedral angle under `minimumAngle` (degrees).
void moveVertices(TetMesh& mesh, const std::vector<std::int32_t>& vertices, const std::vector<Vec3>& target,
                  double minimumAngle);

} // namespace surgicalmesher
