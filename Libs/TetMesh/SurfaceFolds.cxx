// SPDX-License-Identifier: Apache-2.0
#include "SurfaceFolds.h"

#include "UnionFind.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace surgicalmesher
{
namespace
{

using EdgePoints = std::array<std::int32_t, 2>;

/// An edge of a triangle.
struct Side
{
  EdgePoints points; // ascending
  std::int32_t triangle;
};

std::vector<Side> sidesOf(const SurfaceComplex& surface)
{
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
    {
      const auto [low, high] = std::minmax(surface.triangles[t][c], surface.triangles[t][(c + 1) % 3]);
      sides.push_back({ { low, high }, std::int32_t(t) });
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b)
            { return std::tie(a.points, a.triangle) < std::tie(b.points, b.triangle); });
  return sides;
}

/// The labels of a triangle: the larger, then the smaller one.
std::array<Label, 2> pairOf(const SurfaceComplex& surface, std::int32_t t)
{
  const auto& [behind, front] = surface.labels[t];
  return { std::max(behind, front), std::min(behind, front) };
}

/// Unit normal of a triangle, out of the larger label.
Vec3 normalOf(const SurfaceComplex& surface, std::int32_t t)
{
  const auto& [a, b, c] = surface.triangles[t];
  const Vec3 normal = cross(surface.points[b] - surface.points[a], surface.points[c] - surface.points[a]);
  return normal / (surface.labels[t][0] > surface.labels[t][1] ? norm(normal) : -norm(normal));
}

double degreesBetween(const Vec3& a, const Vec3& b)
{
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::acos(-1.0);
}

/// The properties that all edges of a fold share.
struct FoldKind
{
  bool isOuter, isConcave;
  std::array<Label, 2> labels;

  bool operator==(const FoldKind& other) const
  {
    return isOuter == other.isOuter && isConcave == other.isConcave && labels == other.labels;
  }
};

struct FoldedEdge
{
  FoldKind kind;
  EdgePoints points;
  double length;
  Vec3 middle;
  double boundaryTurn; // degrees; -1: unknown
};

class FoldFinder
{
public:
  FoldFinder(const SurfaceComplex& surface, const std::vector<Vec3>& boundaryNormals)
    : m_Surface(surface), m_BoundaryNormals(boundaryNormals)
  {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) m_Normals.push_back(normalOf(surface, std::int32_t(t)));
  }

  /// Examines an edge. `first`, `last`: all triangles at it.
  void add(std::vector<Side>::const_iterator first, std::vector<Side>::const_iterator last, SurfaceFolds& result)
  {
    std::vector<std::int32_t> outer;
    for (auto side = first; side != last; ++side)
    {
      if (pairOf(m_Surface, side->triangle)[1] == 0) outer.push_back(side->triangle);
    }
    const bool isSheet =
      last - first == 2 && pairOf(m_Surface, first->triangle) == pairOf(m_Surface, (first + 1)->triangle);
    if (isSheet) count(first->points, first->triangle, (first + 1)->triangle, result.sheets);
    if (outer.size() == 2) count(first->points, outer[0], outer[1], result.outer);
    if (outer.size() == 2) keepIfFolded(first->points, outer[0], outer[1], true);
    else if (isSheet) keepIfFolded(first->points, first->triangle, (first + 1)->triangle, false);
  }

  std::vector<FoldedEdge> takeEdges() { return std::move(m_Edges); }

private:
  bool isFolded(std::int32_t a, std::int32_t b) const
  {
    return dot(m_Normals[a], m_Normals[b]) < -1e-9; // a right angle is no fold
  }

  double lengthOf(const EdgePoints& points) const
  {
    return norm(m_Surface.points[points[1]] - m_Surface.points[points[0]]);
  }

  void count(const EdgePoints& points, std::int32_t a, std::int32_t b, FoldedLength& total) const
  {
    total.length += lengthOf(points);
    if (isFolded(a, b)) total.folded += lengthOf(points);
  }

  /// Whether the larger label is on the convex side: its dihedral angle is below 180 degrees.
  bool isConvex(const EdgePoints& points, std::int32_t a, std::int32_t b) const
  {
    Vec3 opposite;
    for (const std::int32_t p : m_Surface.triangles[b])
    {
      if (p != points[0] && p != points[1]) opposite = m_Surface.points[p];
    }
    return dot(m_Normals[a], opposite - m_Surface.points[points[0]]) < 0;
  }

  double boundaryTurn(std::int32_t a, std::int32_t b) const
  {
    if (m_BoundaryNormals.empty()) return -1;
    const Vec3 &m = m_BoundaryNormals[a], &n = m_BoundaryNormals[b];
    return squaredNorm(m) > 0 && squaredNorm(n) > 0 ? degreesBetween(m, n) : -1;
  }

  void keepIfFolded(const EdgePoints& points, std::int32_t a, std::int32_t b, bool isOuter)
  {
    if (!isFolded(a, b)) return;
    const bool convex = isConvex(points, a, b);
    FoldKind kind{ isOuter, isOuter && !convex, pairOf(m_Surface, a) };
    const Label other = pairOf(m_Surface, b)[0];
    if (isOuter) kind.labels = { std::min(kind.labels[0], other), std::max(kind.labels[0], other) };
    else if (!convex) std::swap(kind.labels[0], kind.labels[1]);
    const Vec3 middle = 0.5 * (m_Surface.points[points[0]] + m_Surface.points[points[1]]);
    m_Edges.push_back({ kind, points, lengthOf(points), middle, boundaryTurn(a, b) });
  }

  const SurfaceComplex& m_Surface;
  const std::vector<Vec3>& m_BoundaryNormals;
  std::vector<Vec3> m_Normals;
  std::vector<FoldedEdge> m_Edges;
};

/// Chains of edges of one kind that are connected by points, in the order of their first edges.
std::vector<std::vector<FoldedEdge>> chainsOf(const std::vector<FoldedEdge>& edges)
{
  std::vector<std::pair<std::int32_t, std::uint32_t>> ends;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const std::int32_t p : edges[e].points) ends.emplace_back(p, std::uint32_t(e));
  std::sort(ends.begin(), ends.end());
  UnionFind sets(edges.size());
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = i + 1; j < ends.size() && ends[j].first == ends[i].first; ++j)
    {
      if (edges[ends[i].second].kind == edges[ends[j].second].kind) sets.unite(ends[i].second, ends[j].second);
    }
  std::vector<std::vector<FoldedEdge>> bySet(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) bySet[sets.find(std::uint32_t(e))].push_back(edges[e]);
  bySet.erase(std::remove_if(bySet.begin(), bySet.end(), [](const auto& chain) { return chain.empty(); }), bySet.end());
  return bySet;
}

Vec3 placeOf(const std::vector<FoldedEdge>& chain, double length)
{
  Vec3 centre;
  for (const FoldedEdge& edge : chain) centre += edge.length / length * edge.middle;
  const auto nearest = [&](const FoldedEdge& a, const FoldedEdge& b)
  { return squaredNorm(a.middle - centre) < squaredNorm(b.middle - centre); };
  return std::min_element(chain.begin(), chain.end(), nearest)->middle;
}

double meanBoundaryTurn(const std::vector<FoldedEdge>& chain)
{
  double sum = 0, length = 0;
  for (const FoldedEdge& edge : chain)
  {
    if (edge.boundaryTurn < 0) continue;
    sum += edge.length * edge.boundaryTurn;
    length += edge.length;
  }
  return length > 0 ? sum / length : -1;
}

/// Whether the fold is the edge of a thin tissue along at least half of its length.
bool isThinAlong(const std::vector<FoldedEdge>& chain, const Fold& fold, const IsThin& isThin)
{
  double thin = 0;
  for (const FoldedEdge& edge : chain)
  {
    const bool first = isThin(fold.labels[0], edge.middle);
    if (first || (fold.isOuter && isThin(fold.labels[1], edge.middle))) thin += edge.length;
  }
  return 2 * thin >= fold.length;
}

FoldReason reasonOf(const std::vector<FoldedEdge>& chain, const Fold& fold, const IsThin& isThin)
{
  if (fold.isConcave) return fold.labels[0] == fold.labels[1] ? FoldReason::Crack : FoldReason::Groove;
  if (isThinAlong(chain, fold, isThin)) return FoldReason::ThinTissue;
  return fold.boundaryTurn > 90 ? FoldReason::Boundary : FoldReason::Surface;
}

Fold foldOf(const std::vector<FoldedEdge>& chain, const IsThin& isThin)
{
  const FoldKind& kind = chain.front().kind;
  Fold fold;
  fold.isOuter = kind.isOuter;
  fold.isConcave = kind.isConcave;
  fold.labels = kind.labels;
  fold.edges = chain.size();
  for (const FoldedEdge& edge : chain) fold.length += edge.length;
  fold.place = placeOf(chain, fold.length);
  fold.boundaryTurn = meanBoundaryTurn(chain);
  fold.reason = reasonOf(chain, fold, isThin);
  return fold;
}

} // namespace

std::string_view nameOf(FoldReason reason)
{
  constexpr std::array<std::string_view, foldReasons> names{ "groove between two tissues", "crack",
                                                             "edge of a thin tissue", "edge in the map",
                                                             "edge of the surface alone" };
  return names[std::size_t(reason)];
}

SurfaceFolds surfaceFolds(const SurfaceComplex& surface, const std::vector<Vec3>& boundaryNormals, const IsThin& isThin)
{
  const std::vector<Side> sides = sidesOf(surface);
  SurfaceFolds result;
  FoldFinder finder(surface, boundaryNormals);
  for (auto first = sides.begin(); first != sides.end();)
  {
    const auto last = std::find_if(first, sides.end(), [&](const Side& side) { return side.points != first->points; });
    finder.add(first, last, result);
    first = last;
  }
  for (const auto& chain : chainsOf(finder.takeEdges())) result.folds.push_back(foldOf(chain, isThin));
  std::stable_sort(result.folds.begin(), result.folds.end(),
                   [](const Fold& a, const Fold& b) { return a.length > b.length; });
  return result;
}

std::vector<Vec3> boundaryNormals(const BackgroundMesh& background)
{
  const TetMesh& mesh = background.mesh;
  std::vector<std::array<Vec3, 4>> sums(mesh.tetrahedra.size());
  for (const BackgroundMesh::Sample& sample : background.samples)
  {
    const Vec3 normal{ sample.normal[0], sample.normal[1], sample.normal[2] }; // not a unit vector: see BackgroundMesh
    if (squaredNorm(normal) > 0) sums[sample.tetrahedron][sample.face] += normal / norm(normal);
  }
  std::vector<Vec3> result;
  for (const InterfaceFace& face : interfaceFaces(mesh, background.neighbours))
    result.push_back(sums[face.tetrahedron][face.face]);
  return result;
}

} // namespace surgicalmesher
