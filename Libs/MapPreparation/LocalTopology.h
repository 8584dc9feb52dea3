// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Effects of changing one voxel on the topology of the labels around it.

#include "TissueMap.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace surgicalmesher
{

/// Labels of 2x2x2 voxels; bit 0 of an index is i, bit 1 j, bit 2 k.
using Block = std::array<Label, 8>;

/// Labels of 3x3x3 voxels: i + 3 j + 9 k, the centre at 13 (neighbourSteps()).
using Neighbourhood = std::array<Label, 27>;

/// Returns the labels at the given memory offsets from a voxel.
template <std::size_t N>
std::array<Label, N> gather(const TissueMap& map, std::size_t voxel, const std::array<std::ptrdiff_t, N>& steps)
{
  std::array<Label, N> result;
  for (std::size_t n = 0; n < N; ++n) result[n] = map.labels[voxel + steps[n]];
  return result;
}

/// Whether a label of the block, or the rest of the block, touches itself only along an edge or a corner
/// (MapPreparation.h).
bool isCritical(const Block& block);

/// Number of critical blocks among the eight that contain the centre.
int criticalBlocks(const Neighbourhood& around);

/// Number of face-connected components of `label` among the 18 voxels that share a face or an edge with the centre;
/// components that do not touch the centre by a face do not count. One means that the centre can join or leave the
/// label without joining or splitting the label around it.
int partsAround(const Neighbourhood& around, Label label);

/// A set of voxels of a neighbourhood, one bit each.
using VoxelMask = std::uint32_t;

/// Returns the connected component of the lowest voxel, through faces alone or across edges and corners as well.
VoxelMask firstPart(VoxelMask voxels, bool throughFacesOnly);

/// Whether both its own label and `label` keep their topology under (6, 26) connectivity when the centre goes to
/// `label`: whether it is a simple point of both (Bertrand and Malandain 1994).
bool isSimple(const Neighbourhood& around, Label label);

/// Whether isSimple() holds and the change leaves a well-composed map well-composed.
bool keepsTopology(const Neighbourhood& around, Label label);

} // namespace surgicalmesher
