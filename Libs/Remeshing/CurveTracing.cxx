// SPDX-License-Identifier: Apache-2.0
#include "CurveTracing.h"

#include "Errors.h"
#include "FaceAdjacency.h"
#include "Place.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

namespace surgicalmesher
{

namespace
{

// All in target lengths.
constexpr double snapping = 0.06;    // a chain passes through vertices, edges and faces this near to its curve
constexpr double attraction = 0.045; // and follows an interface this near
constexpr double leastStep = 1e-3;   // between vertices of a chain
constexpr double ahead = 0.1;        // step in which a target is searched for along the curve
constexpr double farthest = 2;       // distance along the curve to the farthest target

/// A vertex, edge or face of a tetrahedron, or the tetrahedron itself: 1 to 4 of its corners.
struct Simplex
{
  std::int32_t tet;
  std::array<int, 4> corners; ///< the first `count`, as numbers in tet
  int count;
};

/// Returns the point of the simplex nearest to p, unless it lies on the border of the simplex. Of a tetrahedron it is
/// p, which must lie inside.
std::optional<Vec3> nearestInside(const std::vector<Vec3>& corners, const Vec3& p)
{
  if (corners.size() == 1) return corners[0];
  if (corners.size() == 4) return p;
  const Vec3 o = corners[0], u = corners[1] - o, d = p - o;
  if (corners.size() == 2)
  {
    const double share = dot(d, u) / squaredNorm(u);
    return share > 0 && share < 1 ? std::optional(o + share * u) : std::nullopt;
  }
  const Vec3 v = corners[2] - o, n = cross(u, v);
  const double n2 = squaredNorm(n), a = dot(cross(d, v), n) / n2, b = dot(cross(u, d), n) / n2;
  return a > 0 && b > 0 && a + b < 1 ? std::optional(o + a * u + b * v) : std::nullopt;
}

/// The place where a ray from a vertex to a target leaves the star of the vertex.
struct Exit
{
  std::int32_t tet = -1; ///< tetrahedron that the ray passes through; -1: none
  Vec3 point;
  bool isReached = false; ///< the target lies inside the star: `point` is the target
};

class Tracing
{
public:
  Tracing(TetComplex& complex, CurveChains& chains) : m_Complex(complex), m_Chains(chains), m_Network(chains.network())
  {
  }

  void run()
  {
    for (std::size_t n = 0; n < m_Network.arcs.size(); ++n)
      for (int end = 0; end < 2; ++end) placeNode(n, end);
    for (std::size_t n = 0; n < m_Network.arcs.size(); ++n) trace(n);
  }

private:
  /// Whether a vertex of a chain may lie at q. `vertex`: an existing vertex there; -1: a new one.
  using Accept = std::function<bool(const Vec3& q, std::int32_t vertex)>;

  [[noreturn]] void refuseOutside(std::size_t arc, const Vec3& p) const
  {
    throw InputError(m_Network.sources[m_Network.arcs[arc].curve] + ": the curve leaves the tissues near " + place(p) +
                     " LPS, expected one inside the mesh");
  }

  // --- vertices
  std::vector<Vec3> cornersOf(const Simplex& simplex) const
  {
    std::vector<Vec3> corners;
    for (int k = 0; k < simplex.count; ++k)
      corners.push_back(m_Complex.points[m_Complex.tets[simplex.tet][simplex.corners[k]]]);
    return corners;
  }

  /// Returns the tetrahedra that contain a simplex of two or more corners; none if some lie outside the complex.
  std::vector<std::int32_t> around(const Simplex& simplex) const
  {
    const auto& x = m_Complex.tets[simplex.tet];
    std::vector<std::int32_t> result, vertices;
    if (simplex.count == 4) return { simplex.tet };
    if (simplex.count == 3)
    {
      const std::int32_t beyond =
        m_Complex.neighbours[simplex.tet][6 - simplex.corners[0] - simplex.corners[1] - simplex.corners[2]];
      return beyond < 0 ? result : std::vector<std::int32_t>{ simplex.tet, beyond };
    }
    if (!m_Complex.ring(x[simplex.corners[0]], x[simplex.corners[1]], simplex.tet, result, vertices)) result.clear();
    return result;
  }

  /// Splits all tetrahedra that contain the simplex at a new vertex, q, inside it. Returns the vertex; -1 if a part
  /// would have no positive volume, or if the simplex is on the border of the complex.
  std::int32_t split(const Simplex& simplex, const Vec3& q)
  {
    auto& c = m_Complex;
    const std::vector<std::int32_t> old = around(simplex);
    std::vector<std::int32_t> ids;
    for (int k = 0; k < simplex.count; ++k) ids.push_back(c.tets[simplex.tet][simplex.corners[k]]);
    bool isOnInterface = false;
    for (const std::int32_t t : old)
    {
      isOnInterface |= c.labels[t] != c.labels[old[0]];
      for (const std::int32_t id : ids)
        if (!(c.qualityWith(t, id, q) > 0)) return -1;
    }
    if (old.empty()) return -1;
    const std::int32_t fresh = c.addVertex(q, float(m_Length), isOnInterface);
    std::vector<TetComplex::Tet> tets;
    std::vector<Label> labels;
    for (const std::int32_t t : old)
      for (const std::int32_t id : ids)
      {
        tets.push_back(c.tets[t]);
        tets.back()[c.indexOf(t, id)] = fresh;
        labels.push_back(c.labels[t]);
      }
    c.replace(old, tets, labels);
    return fresh;
  }

  /// Returns a vertex at or near p in tetrahedron t, a corner or one made by a split: the first that is accepted, tried
  /// at corners, edges, faces and the inside in turn. `without`: number of a corner that these must not contain; -1:
  /// none. Returns -1 if none is accepted.
  std::int32_t vertexAt(const Vec3& p, std::int32_t t, int without, const Accept& accept)
  {
    const auto x = m_Complex.tets[t];
    for (int count = 1; count <= (without < 0 ? 4 : 3); ++count)
      for (const Simplex& simplex : simplices(t, count, without, p))
      {
        const std::optional<Vec3> q = nearestInside(cornersOf(simplex), p);
        if (count == 2 && m_Chains.isEdge(x[simplex.corners[0]], x[simplex.corners[1]])) continue;
        const std::int32_t corner = count == 1 ? x[simplex.corners[0]] : -1;
        if (!q || !accept(*q, corner)) continue;
        if (corner >= 0) return corner;
        if (const std::int32_t v = split(simplex, *q); v >= 0) return v;
      }
    return -1;
  }

  /// Returns the simplices of t with `count` corners that are near to p, nearest first.
  std::vector<Simplex> simplices(std::int32_t t, int count, int without, const Vec3& p) const
  {
    std::vector<std::pair<double, Simplex>> found;
    for (int mask = 1; mask < 16; ++mask)
    {
      Simplex simplex{ t, {}, 0 };
      for (int k = 0; k < 4; ++k)
        if (mask >> k & 1) simplex.corners[simplex.count++] = k;
      if (simplex.count != count || (without >= 0 && (mask >> without & 1))) continue;
      const std::optional<Vec3> q = nearestInside(cornersOf(simplex), p);
      if (q && norm(*q - p) <= snapping * m_Length) found.push_back({ norm(*q - p), simplex });
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Simplex> result;
    for (const auto& [distance, simplex] : found) result.push_back(simplex);
    return result;
  }

  // --- nodes
  void placeNode(std::size_t arcNumber, int end)
  {
    const CurveArc& arc = m_Network.arcs[arcNumber];
    if (m_Chains.nodeVertex(arc.nodes[end]) >= 0) return;
    const Vec3 p = end ? arc.aims.back() : arc.aims.front();
    m_Length = end ? arc.lengths.back() : arc.lengths.front();
    const std::int32_t t = tissueAt(p);
    if (t < 0) refuseOutside(arcNumber, p);
    const Vec3 exact = end ? arc.points.back() : arc.points.front();
    const std::int32_t v = vertexAt(p, t, -1,
                                    [&](const Vec3& q, std::int32_t vertex) {
                                      return (vertex < 0 || !m_Chains.isOn(vertex)) &&
                                             norm(q - exact) <= 0.8 * m_Chains.tolerance() * m_Length;
                                    });
    if (v < 0) throw EngineError("no vertex of a curve can lie at " + place(p));
    m_Chains.setNode(arc.nodes[end], v);
  }

  /// Returns the tetrahedron of a tissue that contains p; -1: none.
  std::int32_t tissueAt(const Vec3& p) const
  {
    constexpr double rounding = -1e-6;
    double best = rounding;
    std::int32_t at = -1;
    for (std::int32_t t = 0; t < std::int32_t(m_Complex.tets.size()); ++t)
    {
      if (!m_Complex.alive(t) || m_Complex.labels[t] == 0) continue;
      const auto& x = m_Complex.tets[t];
      const Vec3 *a = &m_Complex.points[x[0]], *b = &m_Complex.points[x[1]], *c = &m_Complex.points[x[2]],
                 *d = &m_Complex.points[x[3]];
      const double whole = orient(*a, *b, *c, *d);
      const double least =
        std::min({ orient(p, *b, *c, *d), orient(*a, p, *c, *d), orient(*a, *b, p, *d), orient(*a, *b, *c, p) }) /
        whole;
      if (least > best) best = least, at = t;
    }
    return at;
  }

  // --- arcs
  void trace(std::size_t arcNumber)
  {
    const CurveArc& arc = m_Network.arcs[arcNumber];
    const std::int32_t end = m_Chains.nodeVertex(arc.nodes[1]);
    std::int32_t a = m_Chains.nodeVertex(arc.nodes[0]);
    for (double s = 0; s < arc.length();)
    {
      m_Length = arc.lengthAt(s);
      const auto [b, to] = next(arcNumber, a, s, end);
      m_Chains.link(arcNumber, a, s, b, to);
      a = b;
      s = to;
    }
  }

  /// Returns the vertex after a on the arc, and its arc length. `s`: arc length of a; `end`: last vertex of the arc.
  std::pair<std::int32_t, double> next(std::size_t arcNumber, std::int32_t a, double s, std::int32_t end)
  {
    const CurveArc& arc = m_Network.arcs[arcNumber];
    const Vec3 from = m_Complex.points[a];
    if (isNeighbour(a, end) && !m_Chains.isEdge(a, end) &&
        arc.isFollowed(s, from, arc.length(), m_Complex.points[end], m_Chains.tolerance()))
      return { end, arc.length() };
    double to = s;
    const Accept accept = [&](const Vec3& q, std::int32_t vertex)
    {
      if (vertex == end && vertex >= 0) to = arc.length();
      else to = arc.nearest(q, s, std::min(arc.length() - leastStep * m_Length, s + (farthest + 1) * m_Length));
      if (vertex >= 0 && vertex != end && m_Chains.isOn(vertex)) return false;
      return to >= s + leastStep * m_Length && vertex != a && arc.isFollowed(s, from, to, q, m_Chains.tolerance());
    };
    for (const double most : { farthest, 4 * ahead, ahead })
    {
      const auto [at, target] = targetOf(arc, s, from, end, most);
      const Exit exit = exitTowards(a, target);
      if (exit.tet < 0) continue;
      if (m_Complex.labels[exit.tet] == 0) refuseOutside(arcNumber, exit.point);
      const int without = exit.isReached ? -1 : m_Complex.indexOf(exit.tet, a);
      if (const std::int32_t b = vertexAt(exit.point, exit.tet, without, accept); b >= 0) return { b, to };
    }
    throw EngineError(m_Network.sources[arc.curve] + ": the curve cannot be followed from " + place(from));
  }

  bool isNeighbour(std::int32_t a, std::int32_t b)
  {
    m_Complex.star(a, m_Star);
    return a != b &&
           std::any_of(m_Star.begin(), m_Star.end(), [&](std::int32_t t) { return m_Complex.contains(t, b); });
  }

  /// Returns the farthest place of the arc, at most `most` target lengths ahead, to which the straight line from `from`
  /// stays near to the arc: its arc length and position.
  std::pair<double, Vec3> targetOf(const CurveArc& arc, double s, const Vec3& from, std::int32_t end, double most) const
  {
    double best = std::min(s + ahead * m_Length, arc.length());
    for (double to = best; to < s + most * m_Length; to += ahead * m_Length)
    {
      const double at = std::min(to, arc.length());
      if (!arc.isFollowed(s, from, at, arc.aimAt(at), 0.9 * m_Chains.tolerance())) break;
      best = at;
      if (at == arc.length()) break;
    }
    return { best, best == arc.length() ? m_Complex.points[end] : arc.aimAt(best) };
  }

  /// Returns where the straight line from a to the target leaves the star of a. If the line runs along a face, a
  /// tetrahedron of a tissue is preferred.
  Exit exitTowards(std::int32_t a, const Vec3& target)
  {
    constexpr double along = 0.02; // barycentric coordinate up to which the line counts as along a face
    const Vec3 from = m_Complex.points[a], d = target - from;
    Exit best;
    double bestScore = -along;
    m_Complex.star(a, m_Star);
    for (const std::int32_t t : m_Star)
    {
      const int i = m_Complex.indexOf(t, a);
      const auto& f = kFaceCorners[i];
      Vec3 e[3];
      for (int k = 0; k < 3; ++k) e[k] = m_Complex.points[m_Complex.tets[t][f[k]]] - from;
      const double volume = dot(cross(e[0], e[1]), e[2]);
      double w[3] = { dot(cross(d, e[1]), e[2]) / volume, dot(cross(e[0], d), e[2]) / volume,
                      dot(cross(e[0], e[1]), d) / volume };
      const double sum = w[0] + w[1] + w[2];
      if (!(sum > 0)) continue;
      double score = std::min({ w[0], w[1], w[2] }) / sum;
      if (score > -along && m_Complex.labels[t] != 0) score += 2 * along;
      if (score <= bestScore) continue;
      bestScore = score;
      best.tet = t;
      best.isReached = sum <= 1;
      for (double& weight : w) weight = std::max(0.0, weight);
      const double total = w[0] + w[1] + w[2];
      best.point = best.isReached ? target : from + (w[0] * e[0] + w[1] * e[1] + w[2] * e[2]) / total;
    }
    return best;
  }

  TetComplex& m_Complex;
  CurveChains& m_Chains;
  const CurveNetwork& m_Network;
  double m_Length = 0; ///< target length here
  std::vector<std::int32_t> m_Star;
};

vtkNew<vtkPolyData> interfaceOf(const TetComplex& complex)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : complex.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> triangles;
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    for (int i = 0; i < 4; ++i)
    {
      if (!complex.alive(t) || !complex.isInterfaceOfLesser(t, i)) continue;
      const auto& x = complex.tets[t];
      triangles->InsertNextCell({ x[(i + 1) & 3], x[(i + 2) & 3], x[(i + 3) & 3] });
    }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

} // namespace

void aimAtInterfaces(CurveNetwork& network, const TetComplex& complex)
{
  const vtkNew<vtkPolyData> surface = interfaceOf(complex);
  if (surface->GetNumberOfPolys() == 0) return;
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(surface);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  for (CurveArc& arc : network.arcs)
    for (std::size_t k = 0; k < arc.points.size(); ++k)
    {
      Vec3 p = arc.points[k], nearest;
      vtkIdType id = 0;
      int subId = 0;
      double distance2 = 0;
      const vtkIdType found = locator->FindClosestPointWithinRadius(&p.x, attraction * arc.lengths[k], &nearest.x, cell,
                                                                    id, subId, distance2);
      if (found > 0) arc.aims[k] = nearest;
    }
}

void traceCurves(TetComplex& complex, CurveChains& chains) { Tracing(complex, chains).run(); }

} // namespace surgicalmesher
