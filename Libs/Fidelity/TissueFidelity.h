// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Distances between a surface and the map that it was made from, in both directions and tissue by tissue.
///
/// One direction alone is not enough: where the surface has a stray vertex or a bump at a flat wall, it is far from
/// every boundary of the map, although all samples of the map are near the surface (Aspert, Santa-Cruz and Ebrahimi,
/// ICME 2002, section 2).

#include "TetMesh.h"
#include "TissueMap.h"

#include <cstddef>
#include <limits>
#include <map>

namespace surgicalmesher
{

struct Distances
{
  std::size_t samples = 0;
  std::size_t beyond = 0; ///< samples farther than the bound
  double mean = 0;        ///< mm
  double maximum = 0;     ///< mm
  Vec3 farthest;          ///< the farthest sample, in the frame of the surface
};

struct TissueFidelity
{
  double mapVolume = 0;  ///< mm^3, of the voxels
  double meshVolume = 0; ///< mm^3, enclosed by the surface
  Distances mapToMesh;   ///< from the centres of the voxel faces around the tissue to the tissue's surface
  Distances meshToMap;   ///< from the vertices and centroids of the tissue's surface to the voxel faces around it
};

/// Assesses every tissue of `map` against `surface` (in the grid frame of the map, mm). Distances from the surface to
/// the map are limited to eight times the smallest voxel spacing; distances from the map to a tissue without triangles
/// are infinite. `bound`: distance (mm) above which samples count as `beyond`. The result does not depend on the number
/// of threads.
std::map<Label, TissueFidelity> assessFidelity(const SurfaceComplex& surface, const TissueMap& map,
                                               double bound = std::numeric_limits<double>::infinity());

/// Returns the distances of all tissues together, for one side: &TissueFidelity::mapToMesh or
/// &TissueFidelity::meshToMap.
Distances allDistances(const std::map<Label, TissueFidelity>& tissues, Distances TissueFidelity::*side);

} // namespace surgicalmesher
