// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far the surface lies from the tissue boundaries in the map.

#include "TetMesh.h"

#include <vector>

namespace surgicalmesher
{

/// Signed distance, mm, of each point of `surface` (in the grid frame of `map`) to the nearest face between voxels of
/// different labels: positive where the map has, at the point, the label in front of the surface, negative otherwise.
/// Beyond four voxels, the distance of four voxels.
std::vector<double> boundaryDistances(const SurfaceComplex& surface, const TissueMap& map);

} // namespace surgicalmesher
