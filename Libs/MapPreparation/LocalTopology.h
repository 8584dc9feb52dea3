// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a change of one voxel does to the topology of the labels around it.

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

/// The labels at those steps from a voxel.
template <std::size_t N>
std::array<Label, N> gather(const TissueMap& map, std::size_t voxel, const std::array<std::ptrdiff_t, N>& steps)
{
  std::array<Label, N> result;
  for (std::size_t n = 0; n < N; ++n) result[n] = map.labels[voxel + steps[n]];
  return result;
}

/// Whether a label of the block, or the rest of it, touches itself only along an edge or a corner (MapPreparation.h).
bool isCritical(const Block& block);

/// How many of the eight blocks around the centre are critical.
int criticalBlocks(const Neighbourhood& around);

/// Face-connected parts of `label` among the 18 voxels around the centre, of which only those that touch the centre by
/// a face count. One means that the centre can join or leave the label without its surroundings falling apart or
/// meeting.
int partsAround(const Neighbourhood& around, Label label);

/// Some of the voxels of a neighbourhood, one bit each.
using VoxelMask = std::uint32_t;

/// Those that hang together with the lowest of them, through faces alone or across edges and corners as well.
VoxelMask firstPart(VoxelMask voxels, bool throughFacesOnly);

/// Whether the centre can go to `label` with its own label and that one keeping their topology under (6, 26)
/// connectivity: it is a simple point of both (Bertrand and Malandain 1994).
bool isSimple(const Neighbourhood& around, Label label);

/// Whether that also leaves a well-composed map well-composed.
bool keepsTopology(const Neighbourhood& around, Label label);

} // namespace surgicalmesher
