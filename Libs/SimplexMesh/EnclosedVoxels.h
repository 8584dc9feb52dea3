// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Voxels inside closed surfaces.

#include "TetMesh.h"
#include "TissueMap.h"

namespace surgicalmesher
{

/// Returns the indices, ascending, of the voxels whose centres are inside the closed surface of `tissue`, found by the
/// parity of crossings along the rows of the grid. Surface points are in the grid frame.
std::vector<std::size_t> enclosedVoxels(const SurfaceComplex& surface, Label tissue, const Grid& grid);

} // namespace surgicalmesher
