// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The ambient complex a tissue map starts as: every voxel cut into tetrahedra near the boundaries and where L is
/// small, ever larger tetrahedra of one label away from them.
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
  double relativeSize = 0.8; ///< cubes are cut until their side is at most this share of the target edge length
  int mostLevelsBelowVoxel = 2;
  /// Which voxel faces between two labels get a sample; all, if there is no such function. Called on several threads.
  std::function<bool(const VoxelFace&)> isSampled;
};

struct KuhnLattice
{
  BackgroundMesh background; ///< with samples at the centres of voxel faces between two labels, of tolerance 0
  std::vector<std::pair<std::int32_t, std::int32_t>>
    interfaceFaces; ///< (tetrahedron of the larger label, face), each once
};

/// Points in the grid frame of `map`, mm. The box reaches some voxels beyond the map on every side.
/// Throws EngineError if the scale asks for more cells than can be numbered.
KuhnLattice kuhnLattice(const TissueMap& map, const ScaleField& scale, const LatticeOptions& options,
                        const Progress& progress = {});

} // namespace surgicalmesher
