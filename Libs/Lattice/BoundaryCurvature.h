// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How curved the boundaries of a map's tissues are.

#include "TissueScale.h"

namespace surgicalmesher
{

/// For each face between voxels of two labels, the voxel of the larger label and the larger principal curvature of the
/// smooth boundary (SmoothBoundary.h, of scale `voxels`) there: of the linear change of normals that fits those around
/// best. Of what is found within some voxels on the same sheet the lower quartile counts, so that straight edges between
/// flat sides, and single steps, are not curved. Of anisotropic voxels the smallest spacing counts as the voxel.
std::vector<CurvedVoxel> boundaryCurvatures(const TissueMap& map, double voxels);

} // namespace surgicalmesher
