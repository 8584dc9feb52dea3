// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The initial background mesh of a tissue map: each voxel is cut into tetrahedra near tissue boundaries and where the
/// target length L is small; away from these, tetrahedra of one label grow ever larger.
///
/// Reflected Kuhn cubes under Maubach's bisection (J. M. Maubach, SIAM J. Sci. Comput. 16, 1995): conforming, no
/// dihedral angle under 45 degrees in cubic cells, and every voxel is a union of tetrahedra. For a well-composed map
/// the labelled complex therefore has exactly the map's topology and volumes.

#include "BackgroundMesh.h"
#include "BoundaryFaces.h"
#include "Progress.h"
#include "ScaleField.h"
#include "TissueMap.h"

#include <functional>
#include <utility>
#include <vector>

namespace surgicalmesher
{

struct LatticeOptions
{
  double relativeSize = 0.8; ///< cubes in tissues are cut until their side is at most this share of the target length
  int mostLevelsBelowVoxel = 2; ///< cubes are at most this often halved below the size of a voxel
  /// Returns whether a voxel face between two labels gets a sample; if empty, all do. Called from several threads.
  std::function<bool(const VoxelFace&)> isSampled;
};

struct KuhnLattice
{
  BackgroundMesh background; ///< with samples at the centres of voxel faces between two labels; their tolerance is 0
  /// (tetrahedron of the larger label, number 0..3 of the vertex opposite the face), each interface face once.
  std::vector<std::pair<std::int32_t, std::int32_t>> interfaceFaces;
};

/// Returns the lattice of `map` for the target lengths `scale`. Points are in the grid frame of `map`, mm. The lattice
/// reaches at least eight cells (roughly cubic, as large as a voxel or smaller) beyond the map on every side. Throws
/// EngineError if the scale requires more cells than can be numbered.
KuhnLattice kuhnLattice(const TissueMap& map, const ScaleField& scale, const LatticeOptions& options,
                        const Progress& progress = {});

} // namespace surgicalmesher
