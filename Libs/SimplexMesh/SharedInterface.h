// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Closed surfaces that lie against each other, made one complex.

#include "Progress.h"
#include "SizingFunction.h"
#include "TetMesh.h"
#include "TissueMap.h"

namespace surgicalmesher
{

/// The surfaces in `apart`, each of one tissue with 0 in front, as one complex: where two of them are within `gap` mm
/// of each other there is one interface, midway. Through the voxels that they enclose and their smooth boundary,
/// remeshed at L(x): points move by up to half a voxel. `isFree`, by voxel, says what the gap may consist of. All in
/// the frame of `grid`.
SurfaceComplex withSharedInterfaces(const SurfaceComplex& apart, const Grid& grid, const std::vector<bool>& isFree,
                                    double gap, const SizingFunction& edgeLength, const Progress& progress = {});

} // namespace surgicalmesher
