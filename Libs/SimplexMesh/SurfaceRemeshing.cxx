// SPDX-License-Identifier: Apache-2.0
#include "SurfaceRemeshing.h"

#include "CurvatureScale.h"
#include "SimplexDeformation.h"
#include "SurfaceEdgeLength.h"
#include "SurfaceVolumes.h"

#include <memory>

namespace surgicalmesher
{

namespace
{

/// Relative to L; edges between these bounds stay (Botsch and Kobbelt 2004).
constexpr double shortEdge = 0.8, longEdge = 4. / 3;
constexpr int roundsOfLevel = 2, lastRounds = 10;
constexpr int smoothingSteps = 3;      ///< per round
constexpr int finishingRounds = 6;     ///< improving the worst triangles
constexpr int balancingRounds = 30;    ///< restoring the volumes
constexpr double longestBalance = 0.1; ///< bound on the displacement of a point per round, relative to L
constexpr double wantedQuality = 0.62; ///< triangles below this quality are improved at the end
constexpr double poorQuality = 0.56;   ///< triangles of at least this quality have no angle below 20 degrees

double meanEdge(const SurfaceComplex& surface)
{
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += norm(surface.points[a] - surface.points[b]) + norm(surface.points[b] - surface.points[c]) +
           norm(surface.points[c] - surface.points[a]);
  return sum / (3 * double(surface.triangles.size()));
}

struct Edge
{
  double ratio; ///< length over target length
  std::int32_t a, b;
};

class Remeshing
{
public:
  Remeshing(const SurfaceComplex& original, const std::vector<DualEdge>& sharp, const RemeshingOptions& options,
            std::function<double(const Vec3&)> length)
    : m_Length(std::move(length)), m_Bound(boundOf(options)), m_Boundary(original, reachOf(original, m_Bound)),
      m_Curves(original, sharp), m_Volumes(enclosedVolumes(original))
  {
    begin(original, sharp);
  }

  /// Performs one round with the smaller of L and `level` as target edge length.
  void round(double level)
  {
    m_Level = level;
    if (const double edge = meanEdge(m_Mesh->surface()); edge > 1.5 * m_EdgeAtBegin || edge < 0.6 * m_EdgeAtBegin)
      begin(m_Mesh->surface(), m_Mesh->creases());
    divideLongEdges();
    fuseShortEdges();
    swapEdges(*m_Mesh);
    for (int step = 0; step < smoothingSteps; ++step) smooth();
  }

  void finish()
  {
    m_MinimumQuality = wantedQuality;
    begin(m_Mesh->surface(), m_Mesh->creases());
    for (int n = 0; n < finishingRounds; ++n)
    {
      if (mendTriangles() == 0) break;
      swapEdges(*m_Mesh);
      smooth();
    }
    balanceVolumes();
  }

  SurfaceComplex surface() const { return m_Mesh->surface(); }

private:
  static std::function<double(const Vec3&)> boundOf(const RemeshingOptions& options)
  {
    if (options.chordError > 0) return [bound = options.chordError](const Vec3&) { return bound; };
    return [length = options.edgeLength](const Vec3& p) { return 0.2 * length(p); };
  }

  static double reachOf(const SurfaceComplex& original, const std::function<double(const Vec3&)>& bound)
  {
    double reach = 0;
    for (const Vec3& p : original.points) reach = std::max(reach, bound(p));
    return 3 * reach;
  }

  double length(const Vec3& p) const { return std::min(m_Level, m_Length(p)); }

  void begin(const SurfaceComplex& surface, const std::vector<DualEdge>& creases)
  {
    m_EdgeAtBegin = meanEdge(surface);
    OperatorLimits limits;
    limits.edgeLength = [this](const Vec3& p) { return length(p); };
    limits.proximity = m_Bound;
    limits.isBoundStrict = true;
    limits.minimumQuality = m_MinimumQuality;
    m_Mesh = std::make_unique<SimplexOperators>(surface, m_Boundary, limits, creases);
  }

  double ratio(const Vec3& p, const Vec3& q) const { return norm(p - q) / length(0.5 * (p + q)); }
  double ratio(std::int32_t a, std::int32_t b) const { return ratio(m_Mesh->points()[a], m_Mesh->points()[b]); }

  std::vector<Edge> edgesWhere(const std::function<bool(double)>& holds) const
  {
    std::vector<Edge> edges;
    for (std::int32_t a = 0; a < std::int32_t(m_Mesh->points().size()); ++a)
      if (m_Mesh->alive(a))
        for (const std::int32_t b : m_Mesh->faceNeighbours(a))
          if (a < b && holds(ratio(a, b))) edges.push_back({ ratio(a, b), a, b });
    return edges;
  }

  bool isEdge(std::int32_t a, std::int32_t b) const
  {
    if (!m_Mesh->alive(a) || !m_Mesh->alive(b)) return false;
    const std::vector<std::int32_t> neighbours = m_Mesh->faceNeighbours(a);
    return std::binary_search(neighbours.begin(), neighbours.end(), b);
  }

  void divideLongEdges()
  {
    for (int pass = 0; pass < 4; ++pass)
    {
      std::vector<Edge> edges = edgesWhere([](double ratio) { return ratio > longEdge; });
      std::stable_sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) { return x.ratio > y.ratio; });
      int count = 0;
      for (const Edge& e : edges)
        if (isEdge(e.a, e.b)) count += m_Mesh->cutEdge(e.a, e.b);
      if (count == 0) return;
    }
  }

  /// Whether every edge of b would stay below the split threshold if b moved to a.
  bool staysShort(std::int32_t a, std::int32_t b) const
  {
    const Vec3& p = m_Mesh->points()[a];
    const std::vector<std::int32_t> neighbours = m_Mesh->faceNeighbours(b);
    return std::all_of(neighbours.begin(), neighbours.end(),
                       [&](std::int32_t c) { return ratio(p, m_Mesh->points()[c]) < longEdge; });
  }

  void fuseShortEdges()
  {
    std::vector<Edge> edges = edgesWhere([](double ratio) { return ratio < shortEdge; });
    std::stable_sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) { return x.ratio < y.ratio; });
    for (const Edge& e : edges)
    {
      if (!isEdge(e.a, e.b) || ratio(e.a, e.b) >= shortEdge) continue;
      if (staysShort(e.a, e.b) && staysShort(e.b, e.a)) m_Mesh->fuse(e.a, e.b);
    }
  }

  /// Moves every point once: along its interface or curve towards the mean of its surroundings, weighted so that edges
  /// follow L, and across the interface towards the fit of the triangles to the original, which preserves its volume.
  void smooth()
  {
    std::vector<std::int32_t> ids;
    const SurfaceComplex dual = m_Mesh->surface(&ids);
    const std::vector<Vec3> fit = meansAround(dual, imageForces(dual, m_Boundary));
    const std::vector<Vec3> normals = pointNormals(dual);
    std::vector<Vec3> sums(ids.size());
    std::vector<double> weights(ids.size(), 0);
    for (std::size_t t = 0; t < dual.triangles.size(); ++t)
    {
      const auto& [a, b, c] = dual.triangles[t];
      const Vec3 &p = dual.points[a], &q = dual.points[b], &r = dual.points[c], centroid = (p + q + r) / 3;
      const double target = length(centroid), weight = norm(cross(q - p, r - p)) / (target * target * target);
      for (const std::int32_t v : dual.triangles[t])
      {
        sums[v] += weight * centroid;
        weights[v] += weight;
      }
    }
    for (std::size_t v = 0; v < ids.size(); ++v)
    {
      const Vec3& p = dual.points[v];
      const int order = m_Mesh->junctionOrder(ids[v]);
      if (order == 2) continue;
      if (order == 1)
      {
        slide(ids[v]);
        continue;
      }
      const Vec3 way = sums[v] / weights[v] - p;
      moveTowards(ids[v], p + 0.8 * (way - dot(way, normals[v]) * normals[v]) + fit[v]);
    }
  }

  void slide(std::int32_t a)
  {
    const std::vector<std::int32_t> along = m_Mesh->curveNeighbours(a);
    const Vec3 &p = m_Mesh->points()[a], &q = m_Mesh->points()[along[0]], &r = m_Mesh->points()[along[1]];
    const double toQ = ratio(p, q), toR = ratio(p, r);
    const Vec3 middle = p + 0.5 * ((toQ > toR ? q : r) - p) * (std::abs(toQ - toR) / std::max(toQ, toR));
    moveTowards(a, m_Curves.nearest(middle, m_Mesh->tissuesAt(a), m_Boundary.reach()).value_or(p));
  }

  bool moveTowards(std::int32_t a, const Vec3& target)
  {
    const Vec3 from = m_Mesh->points()[a];
    Vec3 way = target - from;
    for (int tries = 0; tries < 3; ++tries, way = 0.5 * way)
      if (m_Mesh->move(a, from + way)) return true;
    return false;
  }

  // ---- volumes ----

  /// Restores the volumes of the tissues, since coarse triangles cut off what is convex. Points that a guard has held
  /// back are less mobile in the next round, so that the others move more.
  void balanceVolumes()
  {
    std::vector<std::int32_t> ids;
    m_Mesh->surface(&ids);
    std::vector<double> mobility;
    for (const std::int32_t id : ids) mobility.push_back(m_Mesh->isOnCrease(id) ? 0 : 1);
    for (int n = 0; n < balancingRounds; ++n)
    {
      const SurfaceComplex dual = m_Mesh->surface();
      const std::map<Label, double> lacking = lackingVolumes(dual);
      if (isBalanced(lacking)) return;
      const std::vector<Vec3> ways = displacementsForVolumes(dual, lacking, mobility);
      for (std::size_t v = 0; v < ids.size(); ++v)
        if (!balance(ids[v], ways[v])) mobility[v] *= 0.3;
    }
  }

  std::map<Label, double> lackingVolumes(const SurfaceComplex& dual) const
  {
    std::map<Label, double> lacking = m_Volumes;
    for (const auto& [label, volume] : enclosedVolumes(dual)) lacking[label] -= volume;
    return lacking;
  }

  bool isBalanced(const std::map<Label, double>& lacking) const
  {
    constexpr double enough = 1e-4; // relative to the tissue's volume
    return std::all_of(lacking.begin(), lacking.end(),
                       [&](const auto& tissue)
                       { return std::abs(tissue.second) <= enough * m_Volumes.at(tissue.first); });
  }

  /// Returns whether the point moved the whole way, or as far as one round allows.
  bool balance(std::int32_t a, const Vec3& way)
  {
    const Vec3 p = m_Mesh->points()[a];
    const double longest = longestBalance * length(p), share = std::min(1., longest / std::max(norm(way), 1e-300));
    if (norm(way) < 1e-3 * longest || m_Mesh->move(a, p + share * way)) return true;
    moveTowards(a, p + 0.5 * share * way);
    return false;
  }

  // ---- the worst triangles ----

  /// Improves the worst faces, trying each operation in turn. Returns the number of faces changed.
  int mendTriangles()
  {
    std::vector<Edge> worst;
    for (std::int32_t a = 0; a < std::int32_t(m_Mesh->points().size()); ++a)
      if (m_Mesh->alive(a))
        if (const double quality = m_Mesh->faceQuality(a, m_Mesh->points()[a]); quality < wantedQuality)
          worst.push_back({ quality, a, -1 });
    std::stable_sort(worst.begin(), worst.end(), [](const Edge& x, const Edge& y) { return x.ratio < y.ratio; });
    int count = 0;
    for (const Edge& face : worst)
      if (m_Mesh->alive(face.a) && m_Mesh->faceQuality(face.a, m_Mesh->points()[face.a]) < wantedQuality)
        count += mend(face.a);
    return count;
  }

  bool mend(std::int32_t a)
  {
    for (const std::int32_t b : m_Mesh->faceNeighbours(a))
      if (m_Mesh->qualityAfterSwap(a, b) > 1.05 * m_Mesh->edgeQuality(a, b) && m_Mesh->swap(a, b)) return true;
    if (improveByMoves(a)) return true;
    for (const std::int32_t b : m_Mesh->faceNeighbours(a))
      if (ratio(a, b) < 1 && staysShort(a, b) && staysShort(b, a) && m_Mesh->fuse(a, b)) return true;
    const bool isPoor = m_Mesh->faceQuality(a, m_Mesh->points()[a]) < poorQuality;
    return isPoor && !m_Mesh->isOnCrease(a) && improveBesideCurve(a);
  }

  /// Moves a to the best of some places around it or along its curve. Where curves between tissues meet, only the
  /// proximity bound limits the distance.
  bool improveByMoves(std::int32_t a)
  {
    const int order = m_Mesh->junctionOrder(a);
    if (order == 2 && m_Mesh->isOnCrease(a)) return false;
    if (order != 1) return improveByMoves(a, axes(), {});
    const std::vector<Label> tissues = m_Mesh->tissuesAt(a);
    const Vec3 home = m_Mesh->points()[a];
    return improveByMoves(
      a, waysAlong(a), [&](const Vec3& p) { return m_Curves.nearest(p, tissues, m_Boundary.reach()).value_or(home); });
  }

  /// The last resort on curves between tissues: moves a off its curve, by at most a fraction of L.
  bool improveBesideCurve(std::int32_t a)
  {
    constexpr double farthest = 0.1;
    if (m_Mesh->junctionOrder(a) != 1) return improveByMoves(a, axes(), {});
    const std::vector<Label> tissues = m_Mesh->tissuesAt(a);
    return improveByMoves(a, axes(),
                          [&](const Vec3& p)
                          {
                            const std::optional<Vec3> onCurve = m_Curves.nearest(p, tissues, m_Boundary.reach());
                            const double way = onCurve ? norm(p - *onCurve) : 0, most = farthest * length(p);
                            return way > most ? *onCurve + most / way * (p - *onCurve) : p;
                          });
  }

  /// `place`, if given, maps a trial position to the position to use instead.
  bool improveByMoves(std::int32_t a, const std::vector<Vec3>& ways, const std::function<Vec3(const Vec3&)>& place)
  {
    bool isBetter = false;
    for (double step = 0.3 * length(m_Mesh->points()[a]), least = 0.05 * step; step > least; step *= 0.5)
      for (const Vec3& way : ways)
      {
        const Vec3 p = m_Mesh->points()[a];
        const Vec3 beside = p + step * way, to = place ? place(beside) : beside;
        if (m_Mesh->faceQuality(a, to) > 1.01 * m_Mesh->faceQuality(a, p)) isBetter |= m_Mesh->move(a, to);
      }
    return isBetter;
  }

  static std::vector<Vec3> axes()
  {
    return { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  }

  std::vector<Vec3> waysAlong(std::int32_t a) const
  {
    std::vector<Vec3> ways;
    for (const std::int32_t b : m_Mesh->curveNeighbours(a))
    {
      const Vec3 way = m_Mesh->points()[b] - m_Mesh->points()[a];
      ways.push_back(way / norm(way));
    }
    return ways;
  }

  std::function<double(const Vec3&)> m_Length, m_Bound;
  TissueBoundary m_Boundary;
  SurfaceCurves m_Curves;
  std::map<Label, double> m_Volumes; ///< of the original
  double m_Level = std::numeric_limits<double>::infinity();
  double m_MinimumQuality = 0.3, m_EdgeAtBegin = 0;
  std::unique_ptr<SimplexOperators> m_Mesh;
};

} // namespace

RemeshedSurface remeshSurface(const SurfaceComplex& original, const RemeshingOptions& options, const Progress& progress)
{
  const std::vector<DualEdge> sharp = sharpEdges(original, options.featureAngle, options.edgeLength);
  std::function<double(const Vec3&)> length = options.edgeLength;
  if (options.chordError > 0)
    length = edgeLengthFromPoints(original.points,
                                  lengthsByCurvature(original, sharp, options.edgeLength, options.chordError));
  double longest = 0;
  for (const Vec3& p : original.points) longest = std::max(longest, length(p));
  Remeshing remeshing(original, sharp, options, length);
  std::vector<double> levels;
  for (double level = 2 * meanEdge(original); level < longest; level *= 2)
    levels.insert(levels.end(), roundsOfLevel, level);
  levels.insert(levels.end(), lastRounds, longest);
  for (std::size_t n = 0; n < levels.size(); ++n)
  {
    report(progress, double(n) / double(levels.size() + 1), "remeshing");
    remeshing.round(levels[n]);
  }
  remeshing.finish();
  report(progress, 1, "remeshing");
  RemeshedSurface result;
  result.surface = remeshing.surface();
  for (const Vec3& p : result.surface.points) result.edgeLength.push_back(length(p));
  result.sharpEdges = sharp.size();
  return result;
}

} // namespace surgicalmesher
