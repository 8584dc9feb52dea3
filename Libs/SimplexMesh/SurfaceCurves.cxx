// SPDX-License-Identifier: Apache-2.0
#include "SurfaceCurves.h"

#include "UnionFind.h"

#include <limits>
#include <utility>

namespace surgicalmesher
{

namespace
{

struct SharedEdge
{
  DualEdge ends;
  std::vector<std::int32_t> triangles;
};

/// Returns all edges with their triangles, ascending.
std::vector<SharedEdge> sharedEdges(const SurfaceComplex& surface)
{
  std::vector<std::pair<DualEdge, std::int32_t>> sides;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const auto [low, high] = std::minmax(surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]);
      sides.push_back({ { low, high }, std::int32_t(t) });
    }
  std::sort(sides.begin(), sides.end());
  std::vector<SharedEdge> edges;
  for (const auto& [ends, triangle] : sides)
  {
    if (edges.empty() || edges.back().ends != ends) edges.push_back({ ends, {} });
    edges.back().triangles.push_back(triangle);
  }
  return edges;
}

constexpr double smooth = 0.95; ///< least length of the mean of the unit normals on a smooth side

/// Mean normals of the triangles on either side of an edge.
class SideNormals
{
public:
  SideNormals(const SurfaceComplex& surface, const std::vector<SharedEdge>& edges)
    : m_Surface(surface), m_Seen(surface.triangles.size(), -1)
  {
    std::vector<int> count(surface.triangles.size(), 0);
    m_Beside.assign(surface.triangles.size(), { -1, -1, -1 });
    for (const SharedEdge& edge : edges)
      if (edge.triangles.size() == 2)
        for (int side = 0; side < 2; ++side)
          m_Beside[edge.triangles[side]][count[edge.triangles[side]]++] = edge.triangles[1 - side];
    for (const auto& [a, b, c] : surface.triangles)
    {
      const Vec3 &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
      m_Normals.push_back(cross(q - p, r - p));
      m_Centroids.push_back((p + q + r) / 3);
    }
  }

  /// Returns the cosine between the normals of the two triangles at the edge.
  double cosine(const SharedEdge& edge) const
  {
    return cosine(m_Normals[edge.triangles[0]], m_Normals[edge.triangles[1]]);
  }

  /// Returns the cosine between the mean normals within `radius` on either side; 1 if a side is rough.
  double cosine(const SharedEdge& edge, double radius)
  {
    const Vec3 middle = 0.5 * (m_Surface.points[edge.ends[0]] + m_Surface.points[edge.ends[1]]);
    const Vec3 along = m_Surface.points[edge.ends[1]] - m_Surface.points[edge.ends[0]];
    const auto away = [&](std::int32_t t)
    {
      const Vec3 way = m_Centroids[t] - middle;
      const Vec3 across = way - dot(way, along) / squaredNorm(along) * along;
      return across / std::max(1e-300, norm(across));
    };
    const Vec3 axis = away(edge.triangles[0]) - away(edge.triangles[1]);
    std::array<Vec3, 2> sums;
    std::array<double, 2> areas{ 0, 0 };
    std::vector<std::int32_t> front{ edge.triangles[0], edge.triangles[1] };
    ++m_Search;
    for (const std::int32_t t : front) m_Seen[t] = m_Search;
    while (!front.empty())
    {
      const std::int32_t t = front.back();
      front.pop_back();
      const int side = dot(m_Centroids[t] - middle, axis) > 0 ? 0 : 1;
      sums[side] += m_Normals[t];
      areas[side] += norm(m_Normals[t]);
      for (const std::int32_t n : m_Beside[t])
        if (n >= 0 && m_Seen[n] != m_Search && norm(m_Centroids[n] - middle) < radius)
        {
          m_Seen[n] = m_Search;
          front.push_back(n);
        }
    }
    const bool areSmooth = norm(sums[0]) > smooth * areas[0] && norm(sums[1]) > smooth * areas[1];
    return areSmooth ? cosine(sums[0], sums[1]) : 1;
  }

private:
  static double cosine(const Vec3& m, const Vec3& n) { return dot(m, n) / std::max(1e-300, norm(m) * norm(n)); }

  const SurfaceComplex& m_Surface;
  std::vector<Vec3> m_Normals, m_Centroids;
  std::vector<std::array<std::int32_t, 3>> m_Beside; ///< across edges of exactly two triangles; -1: none
  std::vector<std::int32_t> m_Seen;
  std::int32_t m_Search = 0;
};

double lengthOf(const SurfaceComplex& surface, const DualEdge& edge)
{
  return norm(surface.points[edge[1]] - surface.points[edge[0]]);
}

/// Returns `edges` with extensions: at each end of a piece, up to two edge lengths of `candidates` that continue it
/// straight.
std::vector<DualEdge> withExtensions(const SurfaceComplex& surface, const std::vector<DualEdge>& edges,
                                     const std::vector<DualEdge>& candidates,
                                     const std::function<double(const Vec3&)>& edgeLength)
{
  constexpr double straight = 0.7; // cosine of the turn, at least
  std::vector<std::vector<std::int32_t>> next(surface.points.size());
  for (const auto& [a, b] : candidates)
  {
    next[a].push_back(b);
    next[b].push_back(a);
  }
  std::set<DualEdge> all(edges.begin(), edges.end());
  std::vector<int> count(surface.points.size(), 0);
  for (const auto& [a, b] : edges) ++count[a], ++count[b];
  const auto extend = [&](std::int32_t from, std::int32_t at)
  {
    for (double left = 2 * edgeLength(surface.points[at]); left > 0 && count[at] == 1;)
    {
      const Vec3 in = surface.points[at] - surface.points[from];
      std::int32_t best = -1;
      double most = straight;
      for (const std::int32_t to : next[at])
      {
        const Vec3 out = surface.points[to] - surface.points[at];
        const double cosine = dot(in, out) / std::max(1e-300, norm(in) * norm(out));
        if (to != from && cosine > most) most = cosine, best = to;
      }
      if (best < 0) return;
      all.insert({ std::min(at, best), std::max(at, best) });
      ++count[at], ++count[best];
      left -= norm(surface.points[best] - surface.points[at]);
      from = std::exchange(at, best);
    }
  };
  for (const auto& [a, b] : edges)
  {
    extend(a, b);
    extend(b, a);
  }
  return { all.begin(), all.end() };
}

/// Returns the edges without connected pieces that are shorter than twice the edge length there.
std::vector<DualEdge> longPieces(const SurfaceComplex& surface, const std::vector<DualEdge>& edges,
                                 const std::function<double(const Vec3&)>& edgeLength)
{
  UnionFind pieces(surface.points.size());
  for (const auto& [a, b] : edges) pieces.unite(a, b);
  std::vector<double> lengths(surface.points.size(), 0);
  for (const DualEdge& edge : edges) lengths[pieces.find(edge[0])] += lengthOf(surface, edge);
  std::vector<DualEdge> kept;
  for (const DualEdge& edge : edges)
    if (lengths[pieces.find(edge[0])] >= 2 * edgeLength(surface.points[edge[0]])) kept.push_back(edge);
  return kept;
}

} // namespace

std::vector<Label> labelsOf(const std::vector<std::array<Label, 2>>& sides)
{
  std::vector<Label> labels;
  for (const auto& [back, front] : sides) labels.insert(labels.end(), { back, front });
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

std::vector<DualEdge> sharpEdges(const SurfaceComplex& surface, double angle,
                                 const std::function<double(const Vec3&)>& edgeLength)
{
  const double flat = std::cos(angle * std::acos(-1.) / 180);
  const std::vector<SharedEdge> edges = sharedEdges(surface);
  SideNormals normals(surface, edges);
  std::vector<DualEdge> candidates, sharp;
  for (const SharedEdge& edge : edges)
  {
    if (edge.triangles.size() != 2 || normals.cosine(edge) >= flat) continue;
    candidates.push_back(edge.ends);
    const double radius = std::max(edgeLength(surface.points[edge.ends[0]]), lengthOf(surface, edge.ends));
    if (normals.cosine(edge, radius) < flat) sharp.push_back(edge.ends);
  }
  return longPieces(surface, withExtensions(surface, sharp, candidates, edgeLength), edgeLength);
}

SurfaceCurves::SurfaceCurves(const SurfaceComplex& surface, const std::vector<DualEdge>& sharp)
  : m_Points(surface.points), m_Grid(1)
{
  double sum = 0;
  for (const SharedEdge& edge : sharedEdges(surface))
  {
    if (edge.triangles.size() == 2 && !std::binary_search(sharp.begin(), sharp.end(), edge.ends)) continue;
    std::vector<std::array<Label, 2>> sides;
    for (const std::int32_t t : edge.triangles) sides.push_back(surface.labels[t]);
    m_Segments.push_back({ edge.ends, labelsOf(sides) });
    sum += lengthOf(surface, edge.ends);
  }
  m_Grid = BoxGrid(std::max(1e-9, 2 * sum / double(std::max<std::size_t>(1, m_Segments.size()))));
  for (std::size_t s = 0; s < m_Segments.size(); ++s)
  {
    Box box = Box::around(m_Points[m_Segments[s].ends[0]]);
    box.add(m_Points[m_Segments[s].ends[1]]);
    m_Grid.insert(std::int32_t(s), box);
  }
}

std::optional<Vec3> SurfaceCurves::nearest(const Vec3& p, const std::vector<Label>& labels, double reach) const
{
  std::optional<Vec3> found;
  double least = reach;
  m_Grid.visit(Box::around(p, reach),
               [&](std::int32_t s)
               {
                 if (m_Segments[s].labels != labels) return true;
                 const Vec3 &a = m_Points[m_Segments[s].ends[0]], ab = m_Points[m_Segments[s].ends[1]] - a;
                 const Vec3 q = a + std::clamp(dot(p - a, ab) / std::max(1e-300, squaredNorm(ab)), 0., 1.) * ab;
                 if (norm(q - p) < least) least = norm(q - p), found = q;
                 return true;
               });
  return found;
}

std::vector<double> SurfaceCurves::curvatures() const
{
  std::vector<std::vector<std::int32_t>> along(m_Points.size());
  for (const Segment& s : m_Segments)
  {
    along[s.ends[0]].push_back(s.ends[1]);
    along[s.ends[1]].push_back(s.ends[0]);
  }
  std::vector<double> curvatures(m_Points.size(), -1);
  for (std::size_t p = 0; p < along.size(); ++p)
  {
    if (along[p].size() != 2) continue;
    const Vec3 in = m_Points[p] - m_Points[along[p][0]], out = m_Points[along[p][1]] - m_Points[p];
    const double lengths = norm(in) + norm(out), turn = std::atan2(norm(cross(in, out)), dot(in, out));
    curvatures[p] = 2 * turn / std::max(1e-300, lengths);
  }
  return curvatures;
}

} // namespace surgicalmesher
