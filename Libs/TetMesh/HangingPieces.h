// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small pieces of tissues that hang on the rest by one face: soft modes of a solver.

#include "FaceAdjacency.h"

namespace surgicalmesher
{

struct HangingPiece
{
  Label label = 0;
  std::size_t tetrahedra = 0;
  double volume = 0;   ///< mm^3
  Vec3 place;          ///< its centroid
  bool isFree = false; ///< nothing else holds it: only the face's points are in tetrahedra of the rest, of any tissue
};

/// A face that is a bridge of the graph of a tissue's tetrahedra, joined through faces (R. E. Tarjan, "A note on finding
/// the bridges of a graph", 1974), parts its component in two. The smaller part hangs on the larger one if it has at
/// most `largestShare` of the tissue's tetrahedra, or a single one; pieces within others are not counted apart. Label 0
/// is left out. Free ones come first, then the largest. In linear time, but for that order.
std::vector<HangingPiece> hangingPieces(const TetMesh& mesh, double largestShare = 0.02);
/// Where it is known what is across faces.
std::vector<HangingPiece> hangingPieces(const TetMesh& mesh, const AcrossFaces& across, double largestShare = 0.02);

} // namespace surgicalmesher
