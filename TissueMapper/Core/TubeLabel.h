// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conversion of a tube to voxels of a label map.

#include "TissueMap.h"
#include "TubePath.h"

#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// Returns the indices of the voxels of a tube in `grid`, ascending. The tube starts as a face-connected chain of
/// voxels from end to end. It then grows by voxels whose centres lie in the tube, nearest to the axis first, as long as
/// each is a simple point, so that the topology is kept (Bertrand and Malandain, Pattern Recognition Letters 15(2),
/// 1994), and touches no other voxel of the tube along an edge or at a corner only. The result is one piece without
/// tunnels or cavities, even where turns come closer than a voxel. The part of the tube outside the grid is left out;
/// the result is empty if all of it is outside.
std::vector<std::size_t> tubeVoxels(const Grid& grid, const TubePath& tube);

} // namespace surgicalmesher
