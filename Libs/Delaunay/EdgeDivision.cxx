// SPDX-License-Identifier: Apache-2.0
#include "EdgeDivision.h"

#include <algorithm>
#include <map>
#include <queue>
#include <utility>

namespace surgicalmesher
{

namespace
{

constexpr double kLongest = 1.8; ///< relative to the target length: the halves are then no shorter than 0.9 of it

using Edge = std::pair<std::int32_t, std::int32_t>; ///< ascending

class Divider
{
public:
  Divider(const SurfaceComplex& surface, const SizingFunction& edgeLength)
    : m_Surface(surface), m_EdgeLength(edgeLength)
  {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      for (int side = 0; side < 3; ++side) addTriangle(edgeOf(t, side), std::int32_t(t));
    }
  }

  SurfaceComplex divided()
  {
    while (!m_Queue.empty())
    {
      const auto [relative, edge] = m_Queue.top();
      m_Queue.pop();
      if (m_TrianglesAt.count(edge) == 0) continue;
      const Edge longest = longestOnPathFrom(edge);
      halve(longest);
      if (longest != edge) m_Queue.emplace(relative, edge);
    }
    return std::move(m_Surface);
  }

private:
  Edge edgeOf(std::size_t t, int side) const
  {
    const auto& ids = m_Surface.triangles[t];
    return std::minmax(ids[side], ids[(side + 1) % 3]);
  }

  /// Returns the squared length and the edge, so that ids break ties.
  std::pair<double, Edge> lengthOf(const Edge& edge) const
  {
    return { squaredNorm(m_Surface.points[edge.first] - m_Surface.points[edge.second]), edge };
  }

  /// Follows the longest side of the triangles at an edge until no longer side is found. Splitting any other edge first
  /// might not terminate where the target length changes faster than triangles can.
  Edge longestOnPathFrom(Edge edge) const
  {
    for (auto longest = lengthOf(edge);; edge = longest.second)
    {
      for (const std::int32_t t : m_TrianglesAt.at(edge))
        for (int side = 0; side < 3; ++side) longest = std::max(longest, lengthOf(edgeOf(std::size_t(t), side)));
      if (longest.second == edge) return edge;
    }
  }

  Vec3 middleOf(const Edge& edge) const { return 0.5 * (m_Surface.points[edge.first] + m_Surface.points[edge.second]); }

  void addTriangle(const Edge& edge, std::int32_t triangle)
  {
    const auto [at, isNew] = m_TrianglesAt.try_emplace(edge);
    at->second.push_back(triangle);
    if (!isNew) return;
    const double length = norm(m_Surface.points[edge.first] - m_Surface.points[edge.second]);
    const double relative = length / m_EdgeLength(middleOf(edge));
    if (relative > kLongest) m_Queue.emplace(relative, edge);
  }

  void halve(const Edge& edge)
  {
    const std::vector<std::int32_t> around = std::move(m_TrianglesAt.at(edge));
    m_TrianglesAt.erase(edge);
    const auto middle = std::int32_t(m_Surface.points.size());
    m_Surface.points.push_back(middleOf(edge));
    for (const std::int32_t t : around)
    {
      // (a, b, c) with the edge from a to b becomes (a, middle, c), and (middle, b, c) is new.
      int side = 0;
      while (edgeOf(t, side) != edge) ++side;
      auto& ids = m_Surface.triangles[t];
      const std::int32_t b = ids[(side + 1) % 3], c = ids[(side + 2) % 3];
      const auto added = std::int32_t(m_Surface.triangles.size());
      ids[(side + 1) % 3] = middle;
      const std::int32_t a = ids[side];
      std::vector<std::int32_t>& far = m_TrianglesAt.at(std::minmax(b, c));
      std::replace(far.begin(), far.end(), t, added);
      m_Surface.triangles.push_back({ middle, b, c });
      if (!m_Surface.labels.empty()) m_Surface.labels.push_back(std::array<Label, 2>(m_Surface.labels[t]));
      addTriangle(std::minmax(a, middle), t);
      addTriangle(std::minmax(middle, b), added);
      addTriangle(std::minmax(middle, c), t);
      addTriangle(std::minmax(middle, c), added);
    }
  }

  SurfaceComplex m_Surface;
  const SizingFunction& m_EdgeLength;
  std::map<Edge, std::vector<std::int32_t>> m_TrianglesAt;
  std::priority_queue<std::pair<double, Edge>> m_Queue; ///< ids break ties
};

} // namespace

SurfaceComplex withDividedEdges(const SurfaceComplex& surface, const SizingFunction& edgeLength)
{
  return Divider(surface, edgeLength).divided();
}

} // namespace surgicalmesher
