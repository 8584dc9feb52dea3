// SPDX-License-Identifier: Apache-2.0
#include "FacetShape.h"
#include "SimplexOperators.h"

#include <limits>
#include <map>

namespace surgicalmesher
{

namespace
{

/// Returns the ratio of the standard deviations of the vertices along the shorter and the longer axis of the face they
/// form.
double roundnessOf(const std::vector<Vec3>& vertices)
{
  Vec3 mean;
  for (const Vec3& v : vertices) mean += v / double(vertices.size());
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  for (const Vec3& v : vertices)
  {
    const Vec3 d = v - mean;
    xx += d.x * d.x, yy += d.y * d.y, zz += d.z * d.z;
    xy += d.x * d.y, yz += d.y * d.z, zx += d.z * d.x;
  }
  // The third eigenvalue is near zero; the other two follow from the trace and the second invariant.
  const double half = 0.5 * (xx + yy + zz);
  const double second = xx * yy - xy * xy + yy * zz - yz * yz + zz * xx - zx * zx;
  const double spread = std::sqrt(std::max(0., half * half - second));
  return half > 0 ? std::sqrt(std::max(0., half - spread) / (half + spread)) : 0;
}

} // namespace

double SimplexOperators::area(std::int32_t a) const
{
  double sum = 0;
  for (std::int32_t t : m_At[a])
  {
    const auto& [p, q, r] = cornersOf(m_Triangles[t]).corners;
    sum += norm(cross(q - p, r - p)) / 6;
  }
  return sum;
}

Vec3 SimplexOperators::vertex(std::int32_t v) const
{
  const auto& [a, b, c] = m_Triangles[v].corners;
  return (m_Points[a] + m_Points[b] + m_Points[c]) / 3;
}

std::size_t SimplexOperators::mostVertices(std::int32_t a) const
{
  std::map<Label, std::size_t> count;
  std::size_t most = 0;
  for (std::int32_t t : m_At[a])
    for (const Label label : m_Triangles[t].labels) most = std::max(most, ++count[label]);
  return most;
}

double SimplexOperators::edgeRatio(std::int32_t a, std::int32_t b) const
{
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < between.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
    {
      const auto &x = m_Triangles[between[i]].labels, &y = m_Triangles[between[j]].labels;
      if (x[0] != y[0] && x[0] != y[1] && x[1] != y[0] && x[1] != y[1]) continue;
      const Vec3 p = vertex(between[i]), q = vertex(between[j]);
      least = std::min(least, std::sqrt(3.) * norm(p - q) / m_Limits.edgeLength(0.5 * (p + q)));
    }
  return least;
}

double SimplexOperators::centreDistance(std::int32_t a) const
{
  std::map<std::array<Label, 2>, std::pair<Vec3, int>> centres;
  for (std::int32_t t : m_At[a])
  {
    auto& [sum, count] = centres[m_Triangles[t].labels];
    sum += vertex(t);
    ++count;
  }
  double most = 0;
  for (const auto& [labels, centre] : centres)
  {
    const auto nearest = m_Boundary.nearest(centre.first / centre.second, labels);
    most = std::max(most, nearest ? nearest->distance : m_Boundary.reach());
  }
  return most;
}

double SimplexOperators::faceQuality(std::int32_t a, const Vec3& p) const
{
  double worst = 1;
  for (std::int32_t t : m_At[a])
  {
    CornerTriangle shape = cornersOf(m_Triangles[t]);
    for (int k = 0; k < 3; ++k)
      if (shape.ids[k] == a) shape.corners[k] = p;
    worst = std::min(worst, qualityOf(shape));
  }
  return worst;
}

double SimplexOperators::edgeQuality(std::int32_t a, std::int32_t b) const
{
  double worst = 1;
  for (std::int32_t t : trianglesAt(a, b)) worst = std::min(worst, qualityOf(cornersOf(m_Triangles[t])));
  return worst;
}

double SimplexOperators::qualityAfterSwap(std::int32_t a, std::int32_t b) const
{
  const auto [c, d] = endsOf(a, b);
  if (c < 0) return 0;
  return std::min(qualityOf(cornersOf({ { a, d, c }, {} })), qualityOf(cornersOf({ { d, b, c }, {} })));
}

double SimplexOperators::fusion(std::int32_t a, std::int32_t b) const
{
  std::vector<Vec3> vertices;
  Vec3 normalA, normalB;
  for (std::int32_t p : { a, b })
    for (std::int32_t t : m_At[p])
    {
      const auto& [x, y, z] = cornersOf(m_Triangles[t]).corners;
      (p == a ? normalA : normalB) += cross(y - x, z - x);
      if (!contains(m_Triangles[t].corners, p == a ? b : a)) vertices.push_back(vertex(t));
    }
  const double cosine = dot(normalA, normalB) / std::max(1e-300, norm(normalA) * norm(normalB));
  const Vec3 between = m_Points[b] - m_Points[a];
  const double length = norm(between) / m_Limits.edgeLength(m_Points[a] + 0.5 * between);
  return std::max(0., cosine) * roundnessOf(vertices) / (0.2 + length);
}

} // namespace surgicalmesher
