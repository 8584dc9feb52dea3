// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Distances of a surface from the tissue boundaries in the map.

#include "TetMesh.h"

#include <vector>

namespace surgicalmesher
{

/// Squared distance, mm^2, from p (mm, in the grid frame) to the face between voxel v and the next one along the axis.
double squaredDistanceToFace(const Vec3& p, const std::array<int, 3>& v, int axis, const Vec3& spacing);

/// Signed distance, mm, of each point of `surface` (in the grid frame of `map`) to the nearest face between voxels of
/// different labels: positive where the voxel at the point has the label in front of the surface, negative otherwise.
/// Limited to four times the smallest voxel spacing.
std::vector<double> boundaryDistances(const SurfaceComplex& surface, const TissueMap& map);

} // namespace surgicalmesher
