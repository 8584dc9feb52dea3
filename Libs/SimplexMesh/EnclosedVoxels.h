// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Voxels inside closed surfaces.

#include "TetMesh.h"
#include "TissueMap.h"

namespace surgicalmesher
{

/// The voxels, ascending, whose centres are inside the closed surface of `tissue`, by the parity of crossings along the
/// grid's rows. Points in the grid frame.
std::vector<std::size_t> enclosedVoxels(const SurfaceComplex& surface, Label tissue, const Grid& grid);

} // namespace surgicalmesher
