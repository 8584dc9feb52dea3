// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs a local-operation algorithm over a whole mesh, block by block, in parallel.

#include "BackgroundMesh.h"
#include "Progress.h"
#include "TetComplex.h"

#include <functional>
#include <limits>
#include <vector>

namespace surgicalmesher
{

/// What a tetrahedron of label 0, which is let off much, is worth in tetrahedra of a tissue.
constexpr double backgroundCost = 0.35;

/// Size of blocks that have not too much border, are a few megabytes, and enough for two processors at least: small
/// meshes on large maps take long, too.
std::size_t defaultBlockSize(const TetMesh& mesh);
constexpr std::size_t wholeMesh = std::numeric_limits<std::size_t>::max();

/// Cuts the mesh into blocks worth at most `tetrahedraPerBlock` tetrahedra (a k-d tree over their centroids), runs
/// `work` on each as a TetComplex whose border is locked, and puts the results together in the order of the blocks.
/// `round` turns the cuts, so that what is locked in one round is free in the next. The result depends on neither the
/// number of threads nor their timing. If `work` or `progress` throws, so does this, and the mesh is as it was.
void sweepBlocks(BackgroundMesh& background, int round, std::size_t tetrahedraPerBlock,
                 const std::function<void(TetComplex&)>& work, const Progress& progress = {});

} // namespace surgicalmesher
