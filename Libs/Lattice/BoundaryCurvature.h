// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Curvature of the tissue boundaries of a map.

#include "TissueScale.h"

namespace surgicalmesher
{

/// Returns, for each face between voxels of two labels, the voxel of the larger label and the larger principal
/// curvature (1/mm) there of the smooth boundary (SmoothBoundary.h; `voxels`: standard deviation of its Gaussian). The
/// curvature is that of the linear change of normals that fits the normals nearby best. Each face gets the lower
/// quartile of the curvatures within six voxels on the same sheet, so that straight edges between flat sides, and
/// single steps, do not count as curved. One voxel is the smallest spacing if voxels are anisotropic.
std::vector<CurvedVoxel> boundaryCurvatures(const TissueMap& map, double voxels);

} // namespace surgicalmesher
