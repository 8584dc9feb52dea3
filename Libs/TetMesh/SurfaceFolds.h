// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a surface is folded by more than 90 degrees: how much of it, where and why.

#include "BackgroundMesh.h"

#include <functional>
#include <string_view>

namespace surgicalmesher
{

enum class FoldReason
{
  Groove,     ///< outside between two tissues
  Crack,      ///< outside that goes into one tissue
  ThinTissue, ///< the edge of a tissue that is thinner there than elements are long
  Boundary,   ///< the edge of a thicker one, and the boundary that the surface stands for turns as far
  Surface     ///< an edge that the surface alone has
};

constexpr int foldReasons = 5;

/// "groove between two tissues", "crack", "edge of a thin tissue", "edge in the map", "edge of the surface alone".
std::string_view nameOf(FoldReason reason);

/// Folded edges that hang together, of the same labels and on the same side.
struct Fold
{
  bool isOuter = false;   ///< on the surface of all tissues together
  bool isConcave = false; ///< as seen from the tissues; false inside, where it is one tissue's edge
  /// Of an outer fold the tissues of the two triangles, ascending; inside the tissue whose edge it is, and what it is in.
  std::array<Label, 2> labels{ 0, 0 };
  std::size_t edges = 0;
  double length = 0;       ///< mm
  Vec3 place;              ///< middle of the edge nearest to the centre of all
  double boundaryTurn = 0; ///< degrees, mean by length: between what the two triangles stand for; -1: not known
  FoldReason reason = FoldReason::Surface;
};

struct FoldedLength
{
  double length = 0, folded = 0; ///< mm, of edges
};

struct SurfaceFolds
{
  FoldedLength sheets;     ///< edges of two triangles, which have the same two labels
  FoldedLength outer;      ///< edges of two triangles that have label 0 on one side, whatever tissues are on the other
  std::vector<Fold> folds; ///< the longest first
};

/// Whether a tissue is thinner than its elements are long, at a point on its surface.
using IsThin = std::function<bool(Label tissue, const Vec3& place)>;

/// `boundaryNormals`: for each triangle the normal of the boundary that it stands for, out of the larger label; 0, or no
/// normals at all: not known. A tissue is thin along a fold if it is along half of its length. In O(n log n).
SurfaceFolds surfaceFolds(const SurfaceComplex& surface, const std::vector<Vec3>& boundaryNormals,
                          const IsThin& isThin);

/// For each triangle of interfaceOf(background.mesh) the mean of its samples' normals; 0 where there is none. The mesh
/// must know its neighbours.
std::vector<Vec3> boundaryNormals(const BackgroundMesh& background);

} // namespace surgicalmesher
