// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far a surface is from the map that it was made of, seen from both sides, and tissue by tissue.
///
/// The distance from one side alone sees only half: a vertex deep inside a flat wall, or a bump on it, is near the
/// boundary of nothing and far from no sample of the map (Aspert, Santa-Cruz and Ebrahimi, ICME 2002, section 2).

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
  Vec3 farthest;          ///< the sample that is farthest, in the frame of the surface
};

struct TissueFidelity
{
  double mapVolume = 0;  ///< mm^3, of the voxels
  double meshVolume = 0; ///< mm^3, enclosed by the surface
  Distances mapToMesh;   ///< from the centres of the voxel faces around the tissue to the tissue's surface
  Distances meshToMap;   ///< from the vertices and centroids of the tissue's surface to the voxel faces around it
};

/// Of every tissue of `map`, whose surface is `surface` (in the grid frame of the map, mm). Distances from the surface
/// that are over eight voxels count as eight, and from the map to a tissue without a triangle as infinite. `bound`:
/// what `beyond` counts against, mm. The same result whatever the number of threads.
std::map<Label, TissueFidelity> assessFidelity(const SurfaceComplex& surface, const TissueMap& map,
                                               double bound = std::numeric_limits<double>::infinity());

/// Both sides of all tissues taken together.
Distances allDistances(const std::map<Label, TissueFidelity>& tissues, Distances TissueFidelity::*side);

} // namespace surgicalmesher
