// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Blocks of 2, 4 and 8 voxels a side that are given a single label wherever elements are to be several voxels long, so
/// that the mesh there need not start from elements of the size of voxels.
///
/// A mixed block takes the label of most of its voxels, voxel by voxel, each a simple point of the label that loses it
/// and of the label that gains it (Bertrand and Malandain 1994). The block is left as it was if not all of its voxels
/// can be changed so, if a contact arises (MapPreparation.h), or if a label has no voxel left within half a block of
/// one that it lost. So every label, the background included, keeps its topology and its manifold boundary, which moves
/// by less than the largest block: by half a block for each size.

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

/// Makes the blocks of a map uniform. The map must be well-composed; the result is, too. Blocks begin at multiples of
/// their side, counted from voxel (0, 0, 0). A map whose voxels are far from cubes (sides in a ratio of 1.5 or more) is
/// returned unchanged. Deterministic.
TissueMap withUniformBlocks(const TissueMap& map, const ScaleField& scale, const UniformBlocksOptions& options = {});

} // namespace surgicalmesher
