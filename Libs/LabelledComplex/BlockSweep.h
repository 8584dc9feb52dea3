#pragma once
/// Runs a local-operation algorithm over a whole mesh, block by block, in parallel.

#include "FaceNeighbours.h"
#include "Progress.h"
#include "TetComplex.h"

#include <functional>
#include <limits>
#include <vector>

namespace surgicalmesher
{

/// A labelled mesh of a whole box with what its operations need: target lengths and evidence.
struct AmbientMesh
{
  struct Place
  {
    Vec3 position;
    float tolerance; ///< mm
    std::int32_t tetrahedron;
    std::int32_t face; ///< opposite this vertex (0..3); the tetrahedron's label is the larger of the face's two
  };

  TetraMesh mesh;
  std::vector<float> lengths; ///< target edge length at each point, mm
  std::vector<Place> evidence;
  /// Empty before the first sweep, and where the mesh has been changed by other means since.
  AcrossFaces neighbours;
};

/// What a tetrahedron of label 0, which is let off much, is worth in tetrahedra of a tissue.
constexpr double backgroundCost = 0.35;

/// Size of blocks that have not too much border, are a few megabytes, and enough for two processors at least: small
/// meshes on large maps take long, too.
std::size_t fairBlock(const TetraMesh& mesh);
constexpr std::size_t oneBlock = std::numeric_limits<std::size_t>::max();

/// Cuts the mesh into blocks worth at most `tetrahedraPerBlock` tetrahedra (a k-d tree over their centroids), runs `work` on
/// each as a TetComplex whose border is locked, and puts the results together in the order of the blocks. `round` turns
/// the cuts, so that what is locked in one round is free in the next. The result depends on neither the number of threads
/// nor their timing. If `work` or `progress` throws, so does this, and the mesh is as it was.
void sweepBlocks(AmbientMesh& ambient, int round, std::size_t tetrahedraPerBlock,
                 const std::function<void(TetComplex&)>& work, const Progress& progress = {});

} // namespace surgicalmesher
