// SPDX-License-Identifier: Apache-2.0
#include "FacetShape.h"
#include "SimplexOperators.h"

namespace surgicalmesher
{

/// Two faces may fuse if they share exactly one edge on the surface of each tissue that has both, if no two triangles
/// coincide afterwards, and if all tissues in contact here stay in contact.
bool SimplexOperators::keepsTissues(std::int32_t a, std::int32_t b) const
{
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  std::set<Label> tissues;
  std::set<std::array<Label, 2>> pairs, left;
  for (std::int32_t p : { a, b })
    for (std::int32_t t : m_At[p])
    {
      tissues.insert(m_Triangles[t].labels.begin(), m_Triangles[t].labels.end());
      pairs.insert(m_Triangles[t].labels);
      if (!contains(m_Triangles[t].corners, p == a ? b : a)) left.insert(m_Triangles[t].labels);
    }
  if (left != pairs) return false;
  const auto common = [](const std::vector<std::int32_t>& x, const std::vector<std::int32_t>& y)
  {
    std::vector<std::int32_t> both;
    std::set_intersection(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(both));
    return both;
  };
  if (common(faceNeighbours(a), faceNeighbours(b)).size() != between.size()) return false;
  for (const Label tissue : tissues)
  {
    const std::vector<std::int32_t> atA = neighboursOn(tissue, a), atB = neighboursOn(tissue, b);
    if (atA.empty() || atB.empty()) continue;
    const auto edges = std::count_if(
      between.begin(), between.end(),
      [&](std::int32_t t) { return m_Triangles[t].labels[0] == tissue || m_Triangles[t].labels[1] == tissue; });
    if (edges != 2 || common(atA, atB).size() != 2) return false;
  }
  for (std::int32_t t : m_At[a])
    for (std::int32_t s : m_At[b])
    {
      const auto& x = m_Triangles[t].corners;
      const auto& y = m_Triangles[s].corners;
      if (contains(x, b) || contains(y, a)) continue;
      if (std::count_if(x.begin(), x.end(), [&](std::int32_t c) { return c != a && contains(y, c); }) == 2)
        return false;
    }
  return true;
}

/// Two faces may fuse along a curve, or if one of them lies off the curves. Otherwise two parts of curves would merge,
/// which is allowed only across a chamfer.
bool SimplexOperators::keepsCreases(std::int32_t a, std::int32_t b) const
{
  if (m_Creases.empty()) return true;
  const int orderA = junctionOrder(a), orderB = junctionOrder(b);
  if (orderA == 0 || orderB == 0) return true;
  if (!isCurve(a, b)) return isChamfer(a, b);
  if (orderA + orderB == 4) return false;
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  return std::none_of(between.begin(), between.end(),
                      [&](std::int32_t t)
                      {
                        const std::int32_t c = thirdCorner(m_Triangles[t].corners, a, b);
                        return isCurve(a, c) && isCurve(b, c);
                      });
}

/// Whether a and b lie on two parallel creases less than half an edge length apart, which count as one sharp edge at
/// this resolution.
bool SimplexOperators::isChamfer(std::int32_t a, std::int32_t b) const
{
  constexpr double narrow = 0.5, parallel = 0.8;
  const Vec3 between = m_Points[b] - m_Points[a];
  if (norm(between) > narrow * m_Limits.edgeLength(m_Points[a] + 0.5 * between)) return false;
  const std::vector<Vec3> alongA = creaseDirections(a), alongB = creaseDirections(b);
  return std::any_of(
    alongA.begin(), alongA.end(),
    [&](const Vec3& u)
    { return std::any_of(alongB.begin(), alongB.end(), [&](const Vec3& v) { return dot(u, v) > parallel; }); });
}

/// Returns the unit directions of the creases from a; empty if a curve between tissues passes a.
std::vector<Vec3> SimplexOperators::creaseDirections(std::int32_t a) const
{
  std::vector<Vec3> directions;
  for (const std::int32_t b : curveNeighbours(a))
  {
    if (!isCrease(a, b)) return {};
    const Vec3 way = m_Points[b] - m_Points[a];
    directions.push_back(way / std::max(1e-300, norm(way)));
  }
  return directions;
}

} // namespace surgicalmesher
