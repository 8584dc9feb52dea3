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

/// Work for a tetrahedron of label 0, relative to one of a tissue: background has to meet weaker demands
/// (backgroundLeniency).
constexpr double backgroundCost = 0.35;

/// Returns a block size for sweepBlocks(): blocks of a few megabytes without too much border; smaller ones for small
/// meshes, so that at least two processors have work, because small meshes of large maps take long, too.
std::size_t defaultBlockSize(const TetMesh& mesh);
constexpr std::size_t wholeMesh = std::numeric_limits<std::size_t>::max(); ///< as block size: a single block

/// Cuts the mesh into blocks (a k-d tree over the centroids), runs `work` on each block as a TetComplex whose border is
/// locked, and merges the results in the order of the blocks. A block holds at most `tetrahedraPerBlock` tetrahedra,
/// those of label 0 counted as backgroundCost. `round` rotates the cuts, so that vertices locked in one round are free
/// in the next. `progress` receives the share of blocks done. The result depends on neither the number of threads nor
/// their timing. Rethrows what `work` or `progress` throws, and then leaves the mesh unchanged.
void sweepBlocks(BackgroundMesh& background, int round, std::size_t tetrahedraPerBlock,
                 const std::function<void(TetComplex&)>& work, const Progress& progress = {});

} // namespace surgicalmesher
