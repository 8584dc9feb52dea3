// SPDX-License-Identifier: Apache-2.0
#include "FacetShape.h"
#include "SimplexOperators.h"

namespace surgicalmesher
{

std::vector<std::int32_t> SimplexOperators::faceNeighbours(std::int32_t a) const
{
  std::vector<std::int32_t> neighbours;
  for (std::int32_t t : m_At[a])
    for (std::int32_t c : m_Triangles[t].corners)
      if (c != a) neighbours.push_back(c);
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return neighbours;
}

std::vector<std::int32_t> SimplexOperators::neighboursOn(Label tissue, std::int32_t a) const
{
  std::vector<std::int32_t> neighbours;
  for (std::int32_t t : m_At[a])
    if (m_Triangles[t].labels[0] == tissue || m_Triangles[t].labels[1] == tissue)
      for (std::int32_t c : m_Triangles[t].corners)
        if (c != a) neighbours.push_back(c);
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return neighbours;
}

std::vector<std::int32_t> SimplexOperators::trianglesAt(std::int32_t a, std::int32_t b) const
{
  std::vector<std::int32_t> between;
  for (std::int32_t t : m_At[a])
    if (contains(m_Triangles[t].corners, b)) between.push_back(t);
  return between;
}

bool SimplexOperators::isCurve(std::int32_t a, std::int32_t b) const
{
  return trianglesAt(a, b).size() != 2 || isCrease(a, b);
}

std::vector<Label> SimplexOperators::tissuesAt(std::int32_t a) const
{
  std::set<Label> tissues;
  for (std::int32_t t : m_At[a]) tissues.insert(m_Triangles[t].labels.begin(), m_Triangles[t].labels.end());
  return { tissues.begin(), tissues.end() };
}

std::vector<std::int32_t> SimplexOperators::curveNeighbours(std::int32_t a) const
{
  std::vector<std::int32_t> neighbours = faceNeighbours(a);
  neighbours.erase(std::remove_if(neighbours.begin(), neighbours.end(), [&](std::int32_t b) { return !isCurve(a, b); }),
                   neighbours.end());
  return neighbours;
}

int SimplexOperators::junctionOrder(std::int32_t a) const
{
  const std::vector<std::int32_t> along = curveNeighbours(a);
  if (along.size() != 2) return along.empty() ? 0 : 2;
  if (m_Creases.empty()) return 1;
  constexpr double straight = 0.7; // cosine of the turn
  const Vec3 in = m_Points[a] - m_Points[along[0]], out = m_Points[along[1]] - m_Points[a];
  const bool turns = isCrease(a, along[0]) && isCrease(a, along[1]) && dot(in, out) < straight * norm(in) * norm(out);
  return turns ? 2 : 1;
}

bool SimplexOperators::isOnCrease(std::int32_t a) const
{
  const std::vector<std::int32_t> neighbours = faceNeighbours(a);
  return std::any_of(neighbours.begin(), neighbours.end(), [&](std::int32_t b) { return isCrease(a, b); });
}

/// Returns the faces around face a, counter-clockwise; empty unless a lies within one interface.
std::vector<std::int32_t> SimplexOperators::sheetRing(std::int32_t a) const
{
  if (junctionOrder(a) != 0) return {};
  std::vector<std::int32_t> ring;
  std::int32_t at = -1;
  for (std::size_t step = 0; step < m_At[a].size(); ++step)
    for (std::int32_t t : m_At[a])
    {
      const auto& c = m_Triangles[t].corners;
      const int k = c[0] == a ? 0 : c[1] == a ? 1 : 2;
      if (step > 0 && c[(k + 1) % 3] != at) continue;
      ring.push_back(c[(k + 1) % 3]);
      at = c[(k + 2) % 3];
      break;
    }
  const bool once = ring.size() == m_At[a].size() && at == ring[0] && std::count(ring.begin(), ring.end(), at) == 1;
  return once ? ring : std::vector<std::int32_t>{};
}

std::array<std::int32_t, 2> SimplexOperators::endsOf(std::int32_t a, std::int32_t b) const
{
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  if (between.size() != 2) return { -1, -1 };
  const auto forward = [&](const Corners& c)
  { return (c[0] == a && c[1] == b) || (c[1] == a && c[2] == b) || (c[2] == a && c[0] == b); };
  const Corners &x = m_Triangles[between[0]].corners, &y = m_Triangles[between[1]].corners;
  if (forward(x) == forward(y)) return { -1, -1 };
  const std::int32_t left = thirdCorner(x, a, b), right = thirdCorner(y, a, b);
  return forward(x) ? std::array<std::int32_t, 2>{ left, right } : std::array<std::int32_t, 2>{ right, left };
}

} // namespace surgicalmesher
