// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Differences between two maps, piece by piece, by tissue and kind.

#include "PaddedMap.h"

#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// The first four classify pieces that a tissue lost, the last three pieces that it gained. The background counts as a
/// tissue.
enum class ChangeKind
{
  Island, ///< a whole component
  Neck,   ///< joined parts of the tissue that are separate now
  Handle, ///< joined parts of the tissue that are still connected: one loop less
  End,    ///< anything else: a tip, a rim, a layer
  Cavity, ///< a whole component of the tissue's complement
  Tunnel, ///< joined parts of the complement: one passage less
  Cleft   ///< anything else
};

constexpr int changeKinds = 7;

/// "islands", "necks", "handles", "ends", "cavities", "tunnels", "clefts".
const char* nameOf(ChangeKind kind);

/// One connected piece that a tissue lost or gained.
struct MapChange
{
  Label label = 0;
  ChangeKind kind = ChangeKind::Island;
  std::size_t voxels = 0;
  Vec3 place; ///< world, mm: the centre of one of its voxels
};

/// Returns every piece, by tissue, then kind. Each voxel that differs is in one piece that its label in `before` lost,
/// and in one that its label in `after` gained. Lost pieces are connected through faces, gained pieces across edges and
/// corners as well; whether a piece joined others is decided by the voxels around it. Both maps must have the same grid
/// and the same margin of at least one voxel, so that pieces at the border have neighbours. Time grows with the number
/// of voxels that differ.
std::vector<MapChange> mapChanges(const PaddedMap& before, const PaddedMap& after);

} // namespace surgicalmesher
