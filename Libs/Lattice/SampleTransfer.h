// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Boundary samples of a map for the lattice of another one that stands for it, as one of uniform blocks does.

#include "KuhnLattice.h"
#include "SizingFunction.h"

namespace surgicalmesher
{

struct SampleTransferOptions
{
  /// Samples are thinned to so many for each triangle of length L; 0: all voxel faces are kept.
  double perTriangle = 0;
};

/// The samples of `lattice`, which was made of `blocks`, become those of `map`: the centres of its voxel faces between
/// two labels, each held by the nearest face of the lattice between the same two. Where two labels touch in the map
/// but, as far as `reach` voxels, not in the blocks, they have none. `length` is in the grid frame. Both maps have the
/// same grid.
void transferSamples(KuhnLattice& lattice, const TissueMap& blocks, const TissueMap& map, const SizingFunction& length,
                     const SampleTransferOptions& options = {});

} // namespace surgicalmesher
