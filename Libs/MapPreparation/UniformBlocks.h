// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Blocks of 2, 4 and 8 voxels a side that come to hold one label wherever elements are to be several voxels long: what
/// a mesh begins from there need not have the voxels' size.
///
/// A mixed block takes the label that most of its voxels have, voxel by voxel, each a simple point of the label that
/// loses it and of the one that gains it (Bertrand and Malandain 1994). It is left as it was if that does not succeed
/// to its last voxel, leaves a contact (MapPreparation.h), or leaves nothing of a label within half a block of a voxel that
/// it has lost. So every label, the background included, keeps its topology and its manifold boundary, which
/// moves by less than the largest block: by half a block for each size.

#include "ScaleField.h"
#include "TissueMap.h"

#include <set>

namespace surgicalmesher
{

struct UniformBlocksOptions
{
  double relativeSize = 0.5;       ///< the largest side of a block, as a share of L
  std::set<Label> protectedLabels; ///< their boundaries stay
};

/// `map` is well-composed, and so is the result. Blocks begin at multiples of their side, counted from voxel (0, 0, 0).
/// Voxels that are not cubes are left as they are. Deterministic.
TissueMap withUniformBlocks(const TissueMap& map, const ScaleField& scale, const UniformBlocksOptions& options = {});

} // namespace surgicalmesher
