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
  Grid grid;                           ///< of the map that has them
  int times = 1;                       ///< along each axis; 1: the map's voxels are its own
  std::array<int, 3> first{ 0, 0, 0 }; ///< the voxel where the first whole block of times^3 equal ones begins

  std::size_t voxels() const { return std::size_t(times) * times * times; } ///< of a block
};

/// The largest number of times. A map's voxels are its own where its border cuts a block that is not background, where
/// fewer than twelve places along an axis have changes, which may be chance, as in a box, and where `shortestLength` (mm)
/// is less than a quarter of a block's side: the coarser voxels' lattice would give no edges as short.
VoxelRepeats findRepeats(const TissueMap& map, double shortestLength);

/// A voxel for each whole block, of its size and place. The table stays.
TissueMap withoutRepeats(const TissueMap& map, const VoxelRepeats& repeats);

/// The other way round, each voxel a block again; blocks that the border cuts are background. The table stays.
TissueMap withRepeats(const TissueMap& map, const VoxelRepeats& repeats);

} // namespace surgicalmesher
