// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Folds of a surface by more than 90 degrees: their length, place and reason.

#include "BackgroundMesh.h"

#include <functional>
#include <string_view>

namespace surgicalmesher
{

enum class FoldReason
{
  Groove,     ///< the outside enters between two tissues
  Crack,      ///< the outside enters one tissue
  ThinTissue, ///< the edge of a tissue that is thinner there than its elements are long
  Boundary,   ///< the edge of a thicker tissue, whose boundary in the map turns by more than 90 degrees, too
  Surface     ///< an edge of the surface that its boundary in the map does not have
};

constexpr int foldReasons = 5;

/// "groove between two tissues", "crack", "edge of a thin tissue", "edge in the map", "edge of the surface alone".
std::string_view nameOf(FoldReason reason);

/// A connected chain of folded edges that have the same labels on the same sides.
struct Fold
{
  bool isOuter = false;   ///< on the surface of all tissues together
  bool isConcave = false; ///< as seen from the tissues; always false for inner folds
  /// Of an outer fold, the tissues of the two triangles, ascending; of an inner fold, the tissue whose edge it is, and
  /// the label around that.
  std::array<Label, 2> labels{ 0, 0 };
  std::size_t edges = 0;
  double length = 0;       ///< mm
  Vec3 place;              ///< middle of the edge that is nearest to the fold's centre
  double boundaryTurn = 0; ///< degrees between the boundary's normals at both triangles, mean by length; -1: unknown
  FoldReason reason = FoldReason::Surface;
};

struct FoldedLength
{
  double length = 0, folded = 0; ///< mm: of all edges, of the folded ones
};

struct SurfaceFolds
{
  FoldedLength sheets;     ///< edges of two triangles, which have the same two labels
  FoldedLength outer;      ///< edges of two triangles that have label 0 on one side, whatever tissues are on the other
  std::vector<Fold> folds; ///< the longest first
};

/// Whether a tissue is thinner than its elements are long, at a point on its surface.
using IsThin = std::function<bool(Label tissue, const Vec3& place)>;

/// Finds all folds. `boundaryNormals`: for each triangle, the normal of the boundary that it represents, out of the
/// larger label; a zero vector, or no normals at all: unknown. A tissue counts as thin along a fold if it is thin along
/// at least half of the fold's length. Takes O(n log n).
SurfaceFolds surfaceFolds(const SurfaceComplex& surface, const std::vector<Vec3>& boundaryNormals,
                          const IsThin& isThin);

/// Returns, for each triangle of interfaceOf(background.mesh), the sum of the unit normals of its samples; 0 where
/// there is none. `background.neighbours` must be known.
std::vector<Vec3> boundaryNormals(const BackgroundMesh& background);

} // namespace surgicalmesher
