// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small pieces of tissues that are attached to the rest by a single face, which gives a solver soft modes.

#include "FaceAdjacency.h"

namespace surgicalmesher
{

struct HangingPiece
{
  Label label = 0;
  std::size_t tetrahedra = 0;
  double volume = 0;   ///< mm^3
  Vec3 place;          ///< its centroid
  bool isFree = false; ///< attached by nothing else: shares only the face's points with other tetrahedra, of any tissue
};

/// Finds the hanging pieces of all tissues. A face that is a bridge of the graph of a tissue's tetrahedra, connected
/// through faces (R. E. Tarjan, "A note on finding the bridges of a graph", 1974), splits its component in two. The
/// smaller part is a hanging piece if it has at most `largestShare` of the tissue's tetrahedra, or a single one; pieces
/// within others are not listed separately. Label 0 is left out. Sorted: free pieces first, then by volume, the largest
/// first. Takes linear time, apart from sorting.
std::vector<HangingPiece> hangingPieces(const TetMesh& mesh, double largestShare = 0.02);
/// The same for a known adjacency.
std::vector<HangingPiece> hangingPieces(const TetMesh& mesh, const AcrossFaces& across, double largestShare = 0.02);

} // namespace surgicalmesher
