// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A tube as voxels of a label map.

#include "TissueMap.h"
#include "TubePath.h"

#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// Indices of the voxels of a tube in `grid`, ascending. They begin as a chain of voxels from end to end, each sharing
/// a face with the next, and grow outward by the voxels whose centres lie in the tube, nearest to the axis first, as
/// long as each leaves the topology as it is (simple points: Bertrand and Malandain, Pattern Recognition Letters 15(2),
/// 1994) and touches no other along an edge or at a corner alone. The tube is then one piece without tunnel or cavity,
/// even where its turns come closer than a voxel. The part outside the grid is left out; empty if none of it is inside.
std::vector<std::size_t> tubeVoxels(const Grid& grid, const TubePath& tube);

} // namespace surgicalmesher
