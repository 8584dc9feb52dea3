// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The lattice of a map that stands for another one, as one of uniform blocks does, with the other's boundary samples.

#include "KuhnLattice.h"
#include "SizingFunction.h"

#include <functional>

namespace surgicalmesher
{

struct SampleTransferOptions
{
  /// To how many for a triangle of length L (mm) samples are thinned at a voxel face; all are kept, if there is no such
  /// function. Called on several threads.
  std::function<double(const VoxelFace& face, double length)> perTriangle;
};

/// The lattice of `blocks` with the samples of `map`: the centres of its voxel faces between two labels, each held by the
/// nearest face of the lattice between the same two. Where two labels touch in the map but, as far as `reach` voxels, not
/// in the blocks, they have none. `length` is in the grid frame. Both maps have the same grid. Throws as kuhnLattice().
KuhnLattice latticeWithSamplesOf(const TissueMap& map, const TissueMap& blocks, const ScaleField& scale,
                                 const SizingFunction& length, const SampleTransferOptions& options = {},
                                 const Progress& progress = {});

} // namespace surgicalmesher
