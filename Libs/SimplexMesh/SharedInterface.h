// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Merges closed surfaces that lie against each other into one complex.

#include "Progress.h"
#include "SizingFunction.h"
#include "TetMesh.h"
#include "TissueMap.h"

namespace surgicalmesher
{

/// Returns the surfaces in `apart`, each with labels [tissue, 0], as one complex: where two of them are within `gap` mm
/// of each other, they share one interface midway. The surfaces are voxelized, the gaps closed, and the smoothed
/// boundary of the voxels is remeshed at L(x), so points move by up to half a voxel. Only voxels for which `isFree` is
/// true may be filled, and only if both surfaces reach them through such voxels. Of each surface, the largest piece of
/// its voxels stays. All coordinates are in the frame of `grid`.
SurfaceComplex withSharedInterfaces(const SurfaceComplex& apart, const Grid& grid, const std::vector<bool>& isFree,
                                    double gap, const SizingFunction& edgeLength, const Progress& progress = {});

} // namespace surgicalmesher
