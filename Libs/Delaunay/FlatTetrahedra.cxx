// SPDX-License-Identifier: Apache-2.0
#include "FlatTetrahedra.h"

#include "Errors.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace surgicalmesher
{
namespace
{

/// Tetrahedra whose volume is below this share of the cube of their longest edge count as flat; rounding alone reaches
/// that order.
constexpr double kFlat = 1e-11;

using Tetrahedron = std::array<std::int32_t, 4>;

double relativeVolume(const std::vector<Vec3>& points, const Tetrahedron& t)
{
  double longest = 0;
  for (const auto& [i, j] : kEdgeCorners) longest = std::max(longest, squaredNorm(points[t[i]] - points[t[j]]));
  return orient(points[t[0]], points[t[1]], points[t[2]], points[t[3]]) / (longest * std::sqrt(longest));
}

bool has(const Tetrahedron& t, std::int32_t point) { return std::find(t.begin(), t.end(), point) != t.end(); }

Tetrahedron replaced(Tetrahedron t, std::int32_t from, std::int32_t to)
{
  std::replace(t.begin(), t.end(), from, to);
  return t;
}

class Lifter
{
public:
  explicit Lifter(TetMesh& mesh) : m_Mesh(mesh), m_Stars(mesh.points.size())
  {
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    {
      for (const std::int32_t id : mesh.tetrahedra[t]) m_Stars[id].push_back(static_cast<std::int32_t>(t));
    }
  }

  bool lift(std::int32_t t)
  {
    double best = 0;
    std::pair<std::int32_t, std::int32_t> bestEdge;
    Vec3 bestPoint;
    for (const auto& [i, j] : kEdgeCorners)
    {
      const std::int32_t p = m_Mesh.tetrahedra[t][i], q = m_Mesh.tetrahedra[t][j];
      const std::vector<std::int32_t> ring = closedRing(p, q);
      for (const Vec3& point : ring.empty() ? std::vector<Vec3>() : candidates(p, q, ring, t))
      {
        const double worst = worstAfter(p, q, ring, point);
        if (worst <= best) continue;
        best = worst;
        bestEdge = { p, q };
        bestPoint = point;
      }
    }
    if (best <= kFlat) return false;
    split(bestEdge.first, bestEdge.second, bestPoint);
    return true;
  }

private:
  /// Returns the tetrahedra around an edge, or none if the edge lies on an interface or on the hull of the mesh.
  std::vector<std::int32_t> closedRing(std::int32_t p, std::int32_t q) const
  {
    std::vector<std::int32_t> ring;
    std::vector<std::int32_t> link; // the other two points of each tetrahedron; in a closed ring each occurs twice
    for (const std::int32_t t : m_Stars[p])
    {
      if (!has(m_Mesh.tetrahedra[t], q)) continue;
      if (!ring.empty() && m_Mesh.labels[t] != m_Mesh.labels[ring.front()]) return {};
      ring.push_back(t);
      for (const std::int32_t id : m_Mesh.tetrahedra[t])
      {
        if (id != p && id != q) link.push_back(id);
      }
    }
    std::sort(link.begin(), link.end());
    for (std::size_t i = 0; i < link.size(); i += 2)
    {
      if (i + 1 == link.size() || link[i] != link[i + 1]) return {};
    }
    return ring;
  }

  /// Returns points between the midpoint of the edge and the centre of the rest of its ring, at several distances.
  std::vector<Vec3> candidates(std::int32_t p, std::int32_t q, const std::vector<std::int32_t>& ring,
                               std::int32_t flat) const
  {
    const Vec3 middle = 0.5 * (m_Mesh.points[p] + m_Mesh.points[q]);
    Vec3 sum;
    int count = 0;
    for (const std::int32_t t : ring)
    {
      for (const std::int32_t id : m_Mesh.tetrahedra[t])
      {
        if (has(m_Mesh.tetrahedra[flat], id)) continue;
        sum += m_Mesh.points[id];
        ++count;
      }
    }
    std::vector<Vec3> result;
    for (double share = 0.5; count > 0 && share > 1e-4; share /= 2)
    {
      result.push_back(middle + share * (sum / count - middle));
    }
    return result;
  }

  double worstAfter(std::int32_t p, std::int32_t q, const std::vector<std::int32_t>& ring, const Vec3& point)
  {
    const auto id = static_cast<std::int32_t>(m_Mesh.points.size());
    m_Mesh.points.push_back(point);
    double worst = 1;
    for (const std::int32_t t : ring)
    {
      worst = std::min(worst, relativeVolume(m_Mesh.points, replaced(m_Mesh.tetrahedra[t], p, id)));
      worst = std::min(worst, relativeVolume(m_Mesh.points, replaced(m_Mesh.tetrahedra[t], q, id)));
    }
    m_Mesh.points.pop_back();
    return worst;
  }

  void split(std::int32_t p, std::int32_t q, const Vec3& point)
  {
    const std::vector<std::int32_t> ring = closedRing(p, q);
    const auto id = static_cast<std::int32_t>(m_Mesh.points.size());
    m_Mesh.points.push_back(point);
    m_Stars.emplace_back();
    for (const std::int32_t t : ring)
    {
      const auto added = static_cast<std::int32_t>(m_Mesh.tetrahedra.size());
      m_Mesh.tetrahedra.push_back(replaced(m_Mesh.tetrahedra[t], q, id));
      m_Mesh.labels.push_back(m_Mesh.labels[t]);
      m_Mesh.tetrahedra[t] = replaced(m_Mesh.tetrahedra[t], p, id);
      m_Stars[p].erase(std::find(m_Stars[p].begin(), m_Stars[p].end(), t));
      m_Stars[id].push_back(t);
      for (const std::int32_t corner : m_Mesh.tetrahedra[added]) m_Stars[corner].push_back(added);
    }
  }

  TetMesh& m_Mesh;
  std::vector<std::vector<std::int32_t>> m_Stars;
};

} // namespace

void liftFlatTetrahedra(TetMesh& mesh)
{
  std::optional<Lifter> lifter;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    if (relativeVolume(mesh.points, mesh.tetrahedra[t]) > kFlat) continue;
    if (!lifter) lifter.emplace(mesh);
    if (lifter->lift(static_cast<std::int32_t>(t))) continue;
    const Vec3& where = mesh.points[mesh.tetrahedra[t].front()];
    throw EngineError("constrained Delaunay: a flat tetrahedron can't be given a volume at " + place(where));
  }
}

} // namespace surgicalmesher
