// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Maps whose voxels are those of a coarser one, each several times along every axis: what resampling to smaller voxels
/// by nearest neighbours leaves. Such a map says no more than the coarser one; its walls have steps of several voxels,
/// which a surface would take for shape, and all that follows voxels takes that much longer.

#include "TissueMap.h"

namespace surgicalmesher
{

struct VoxelRepeats
{
  int times = 1;                       ///< along each axis; 1: the map's voxels are its own
  std::array<int, 3> first{ 0, 0, 0 }; ///< the voxel where the first whole block of times^3 equal ones begins
};

/// The largest number of times. Blocks that the map's border cuts hold background, else its voxels are its own. So they
/// are where too few places along an axis have changes to rule out chance, as in a box.
VoxelRepeats findRepeats(const TissueMap& map);

/// A voxel for each whole block, as large.
TissueMap withoutRepeats(const TissueMap& map, const VoxelRepeats& repeats);

/// The map on `grid`, of which withoutRepeats() was taken, each voxel a block again. Table and all else are the map's.
TissueMap withRepeats(const TissueMap& map, const VoxelRepeats& repeats, const Grid& grid);

} // namespace surgicalmesher
