// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What became of a map, piece by piece: the differences between two maps, by tissue and kind.

#include "PaddedMap.h"

#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// The first four are kinds of what a tissue lost, the last three of what it gained. Both are asked of background, too.
enum class ChangeKind
{
  Island, ///< a whole component
  Neck,   ///< what joined parts of the tissue that are apart now
  Handle, ///< what joined parts that still hang together: a loop less
  End,    ///< anything else: a tip, a rim, a layer
  Cavity, ///< a whole component of what is not the tissue
  Tunnel, ///< what joined parts of what is not the tissue: a passage less
  Cleft   ///< anything else
};

constexpr int changeKinds = 7;

/// "islands", "necks", "handles", "ends", "cavities", "tunnels", "clefts".
const char* nameOf(ChangeKind kind);

/// One connected piece of what a tissue lost or gained.
struct MapChange
{
  Label label = 0;
  ChangeKind kind = ChangeKind::Island;
  std::size_t voxels = 0;
  Vec3 place; ///< world, mm: the centre of one of its voxels
};

/// Every piece, by tissue, then kind. Each voxel that differs is in one piece that its label `before` lost, and in one
/// that its label `after` gained. Pieces lost are joined through faces, pieces gained through corners as well; whether
/// a piece joined others is seen from the voxels around it. Both maps have the same grid and margin, of one voxel or more:
/// a piece at the border has its neighbours, and theirs are not looked at. Time grows with the number of voxels that differ.
std::vector<MapChange> mapChanges(const PaddedMap& before, const PaddedMap& after);

} // namespace surgicalmesher
