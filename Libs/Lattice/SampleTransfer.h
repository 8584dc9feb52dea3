// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The lattice of a map of uniform blocks, with the boundary samples of the original map that it simplifies.

#include "KuhnLattice.h"
#include "SizingFunction.h"

#include <functional>

namespace surgicalmesher
{

struct SampleTransferOptions
{
  /// Returns the mean number of samples to keep per triangle of edge length `length` (mm) around a voxel face; if
  /// empty, all samples are kept. Called from several threads.
  std::function<double(const VoxelFace& face, double length)> perTriangle;
};

/// Returns the lattice of `blocks` with the samples of `map`: the centres of its voxel faces between two labels, each
/// held by a near face of the lattice between the same two labels. A sample without such a face within about twelve
/// voxels is dropped. `length` takes positions in the grid frame, mm. Both maps must have the same grid. Throws as
/// kuhnLattice().
KuhnLattice latticeWithSamplesOf(const TissueMap& map, const TissueMap& blocks, const ScaleField& scale,
                                 const SizingFunction& length, const SampleTransferOptions& options = {},
                                 const Progress& progress = {});

} // namespace surgicalmesher
