// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The lattice of a map that stands for another one, as one of uniform blocks does, with the other's boundary samples.

#include "KuhnLattice.h"
#include "SizingFunction.h"

namespace surgicalmesher
{

struct SampleTransferOptions
{
  /// Samples are thinned to so many for each triangle of length L; 0: all voxel faces are kept.
  double perTriangle = 0;
};

/// The lattice of `blocks` with the samples of `map`: the centres of its voxel faces between two labels, each held by the
/// nearest face of the lattice between the same two. Where two labels touch in the map but, as far as `reach` voxels, not
/// in the blocks, they have none. `length` is in the grid frame. Both maps have the same grid. Throws as kuhnLattice().
KuhnLattice latticeWithSamplesOf(const TissueMap& map, const TissueMap& blocks, const ScaleField& scale,
                                 const SizingFunction& length, const SampleTransferOptions& options = {},
                                 const Progress& progress = {});

} // namespace surgicalmesher
