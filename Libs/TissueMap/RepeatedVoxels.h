// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Maps in which each voxel of a coarser map is repeated several times along every axis, as resampling to smaller
/// voxels by nearest neighbours produces them. Such a map holds no more information than the coarser one; its walls
/// have steps of several voxels, which a surface would take for shape, and all work per voxel takes longer.

#include "TissueMap.h"

namespace surgicalmesher
{

struct VoxelRepeats
{
  Grid grid;                           ///< of the map with repeated voxels
  int times = 1;                       ///< repetitions along each axis; 1: voxels do not repeat
  std::array<int, 3> first{ 0, 0, 0 }; ///< lowest voxel of the first whole block of times^3 equal voxels

  std::size_t voxels() const { return std::size_t(times) * times * times; } ///< per block
};

/// Finds the largest number of repetitions. Voxels do not count as repeated if the map's border cuts a block that is
/// not background, if labels change at fewer than twelve places along an axis (which may be chance, as in a box), or if
/// the shortest target edge length, `shortestLength` (mm), is less than a quarter of a block's side: the lattice of the
/// coarser voxels has no edges that short.
VoxelRepeats findRepeats(const TissueMap& map, double shortestLength);

/// Returns the coarser map: one voxel for each whole block, of its size and place. The table stays.
TissueMap withoutRepeats(const TissueMap& map, const VoxelRepeats& repeats);

/// The inverse: turns each voxel into a block; blocks that the border cuts become background. The table stays.
TissueMap withRepeats(const TissueMap& map, const VoxelRepeats& repeats);

} // namespace surgicalmesher
