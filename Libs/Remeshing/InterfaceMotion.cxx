// SPDX-License-Identifier: Apache-2.0
#include "InterfaceMotion.h"

#include "TetQuality.h"
#include "TissueOffsets.h"
#include "VertexSteps.h"
#include "VolumeOffsets.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace surgicalmesher
{

namespace
{

/// The interface triangles with a corner where L is below `longest`, oriented out of the larger label, and the faces of
/// the complex that hold their samples.
struct InterfaceTriangles
{
  SurfaceComplex surface;
  std::vector<std::int32_t> ids;              ///< vertex of the complex for each point of `surface`, ascending
  std::vector<TetComplex::FaceOfTet> holders; ///< per triangle, see TetComplex::holder

  InterfaceTriangles(const TetComplex& complex, double longest)
  {
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
      for (int i = 0; complex.alive(t) && complex.mayHaveInterface(t) && i < 4; ++i)
        if (complex.isInterface(t, i) && complex.labels[t] > complex.labels[complex.neighbours[t][i]] &&
            shortestLength(complex, t, i) < longest)
          add(complex, t, i);
    numberPoints(complex);
  }

private:
  static double shortestLength(const TetComplex& complex, std::int32_t t, int i)
  {
    const auto at = [&](int k) { return complex.lengths[complex.tets[t][k & 3]]; };
    return std::min({ at(i + 1), at(i + 2), at(i + 3) });
  }

  void add(const TetComplex& complex, std::int32_t t, int i)
  {
    const auto& x = complex.tets[t];
    const auto& p = complex.points;
    std::array<std::int32_t, 3> v{ x[(i + 1) & 3], x[(i + 2) & 3], x[(i + 3) & 3] };
    if (orient(p[v[0]], p[v[1]], p[v[2]], p[x[i]]) > 0) std::swap(v[1], v[2]);
    surface.triangles.push_back(v);
    surface.labels.push_back({ complex.labels[t], complex.labels[complex.neighbours[t][i]] });
    holders.push_back(complex.holder(t, i));
  }

  void numberPoints(const TetComplex& complex)
  {
    for (const auto& triangle : surface.triangles) ids.insert(ids.end(), triangle.begin(), triangle.end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    for (const std::int32_t v : ids) surface.points.push_back(complex.points[v]);
    for (auto& triangle : surface.triangles)
      for (std::int32_t& v : triangle) v = std::int32_t(std::lower_bound(ids.begin(), ids.end(), v) - ids.begin());
  }
};

class InterfaceMotion
{
public:
  InterfaceMotion(GuardedOperations& operations, const InterfaceMotionOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Least(sine2OfDegrees(options.leastAngle)), m_Start(m_Complex.points), m_Volumes(volumes())
  {
    constexpr double coarse = 4; // in fine lengths; an eighth of `farthest` is left there, and less is invisible
    InterfaceTriangles triangles(m_Complex, coarse * options.fineLength);
    m_Holders = std::move(triangles.holders);
    m_Dual.simplex = simplexMeshOf(triangles.surface, Extent::part);
    m_Dual.surface = std::move(triangles.surface);
    m_Dual.ids = std::move(triangles.ids);
    m_Dual.move = [this](std::int32_t v, const Vec3& p) { return move(v, p); };
    findCurves();
  }

  void run()
  {
    constexpr int balancingRounds = 2;
    SimplexMotion motion(m_Options.motion);
    for (int n = 0; n < m_Options.steps; ++n) motion.step(m_Dual, outerForces());
    for (int round = 0; round < balancingRounds; ++round) balanceVolumes();
  }

private:
  bool move(std::int32_t v, const Vec3& p)
  {
    constexpr double least = 0.03; // share of `farthest`; shorter moves cost as much and are invisible
    const Vec3 q = withinReach(v, p);
    return norm(q - m_Complex.points[v]) > least * m_Options.farthest &&
           m_Operations.move(v, q, std::min(m_Least, m_Operations.qualityAt(v)));
  }

  // ---- external forces

  std::vector<Vec3> outerForces() const
  {
    constexpr double factor = 0.4; // on U(U(p)); stable up to 0.5
    const std::vector<Vec3>& points = m_Dual.surface.points;
    std::vector<Vec3> forces = meanImageForces(), umbrellas(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) umbrellas[p] = umbrella(p, points);
    for (std::size_t p = 0; p < points.size(); ++p) forces[p] -= factor * umbrella(p, umbrellas);
    return forces;
  }

  /// Returns for each point the mean image force of its triangles that hold samples, scaled by the motion's `image`.
  std::vector<Vec3> meanImageForces() const
  {
    const SurfaceComplex& surface = m_Dual.surface;
    std::vector<Vec3> forces(surface.points.size());
    std::vector<int> count(surface.points.size(), 0);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      const auto [tet, face] = m_Holders[t];
      if (m_Complex.sampleHeads[tet][face] < 0) continue;
      const Vec3 force = imageForce(t);
      for (const std::int32_t p : surface.triangles[t]) forces[p] += force, ++count[p];
    }
    for (std::size_t p = 0; p < forces.size(); ++p)
      if (count[p] > 0) forces[p] = m_Options.motion.image / count[p] * forces[p];
    return forces;
  }

  /// Returns the displacement, along the triangle's normal, from triangle t to the mean of its samples.
  Vec3 imageForce(std::size_t t) const
  {
    const SurfaceComplex& surface = m_Dual.surface;
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 n = cross(surface.points[b] - surface.points[a], surface.points[c] - surface.points[a]);
    const auto [tet, face] = m_Holders[t];
    double way = 0;
    int count = 0;
    for (std::int32_t e = m_Complex.sampleHeads[tet][face]; e >= 0; e = m_Complex.samples[e].next, ++count)
      way += dot(m_Complex.samples[e].position - surface.points[a], n);
    return way / (count * squaredNorm(n)) * n;
  }

  // ---- curves between tissues

  /// Returns the number of vertex v of the complex among the moving points; -1 if v does not move.
  std::int32_t pointOf(std::int32_t v) const
  {
    const auto at = std::lower_bound(m_Dual.ids.begin(), m_Dual.ids.end(), v);
    return at != m_Dual.ids.end() && *at == v ? std::int32_t(at - m_Dual.ids.begin()) : -1;
  }

  /// Finds the two neighbours of each point along a curve; none for points off curves and where curves meet, end or
  /// leave the moving part.
  void findCurves()
  {
    constexpr std::array<std::int32_t, 2> none{ -1, -1 };
    FacesAtNeighbours faces;
    for (const std::int32_t v : m_Dual.ids)
    {
      facesAtNeighbours(m_Operations.sheet(v), v, faces);
      std::vector<std::int32_t> along;
      for (const auto& [n, count] : faces)
        if (count > 2) along.push_back(pointOf(n));
      const bool isInside = along.size() == 2 && along[0] >= 0 && along[1] >= 0;
      m_Along.push_back(isInside ? std::array{ along[0], along[1] } : none);
    }
  }

  Vec3 umbrella(std::size_t p, const std::vector<Vec3>& x) const
  {
    const auto& [a, b] = m_Along[p];
    return a < 0 ? Vec3{} : 0.5 * (x[a] + x[b]) - x[p];
  }

  // ---- volumes

  std::map<Label, double> volumes() const
  {
    std::map<Label, double> result;
    const auto& p = m_Complex.points;
    for (std::size_t t = 0; t < m_Complex.tets.size(); ++t)
    {
      if (!m_Complex.alive(std::int32_t(t))) continue;
      const auto& [a, b, c, d] = m_Complex.tets[t];
      result[m_Complex.labels[t]] += orient(p[a], p[b], p[c], p[d]) / 6;
    }
    return result;
  }

  /// Returns the areas, mm^2, by pair of labels, of the interface at unlocked vertices: a third of each face per
  /// vertex.
  std::map<std::pair<Label, Label>, double> areas()
  {
    std::map<std::pair<Label, Label>, double> result;
    for (const std::int32_t v : m_Dual.ids)
    {
      if (m_Complex.locked[v]) continue;
      for (const SheetFace& f : m_Operations.sheet(v).faces)
      {
        const SheetSide side = sideOf(m_Complex, f);
        result[std::minmax(side.from, side.to)] += norm(side.area) / 3;
      }
    }
    return result;
  }

  /// Returns how far (mm) the boundary of each tissue has to move outwards to restore the initial volume.
  TissueOffsets offsets()
  {
    std::map<Label, double> lacking = m_Volumes;
    for (const auto& [label, volume] : volumes()) lacking[label] -= volume;
    return offsetsForVolumes(lacking, areas(), m_Options.farthest);
  }

  void balanceVolumes()
  {
    const TissueOffsets offset = offsets();
    for (const std::int32_t v : m_Dual.ids)
    {
      if (m_Complex.locked[v]) continue;
      const Vec3 p = m_Complex.points[v];
      const Vec3 way = meetingStep(m_Complex, m_Operations.sheet(v), offset);
      moveAlong(m_Operations, v, withinReach(v, p + way) - p, std::min(m_Least, m_Operations.qualityAt(v)));
    }
  }

  /// Returns p, or its projection to within 0.6 `farthest` of the plane of its nearest sample. Without this bound, the
  /// edges of a box become rounder from sweep to sweep, and the volume that they lose swells its walls.
  Vec3 nearSamples(std::int32_t v, const Vec3& p)
  {
    constexpr double share = 0.6; // of `farthest`
    const SheetSample* sample = nearestSample(m_Operations.sheet(v), p).first;
    if (!sample) return p;
    const auto normal = m_Complex.sampleNormal(sample->id);
    const Vec3 n{ normal[0], normal[1], normal[2] };
    const double length = norm(n), most = share * m_Options.farthest;
    if (length == 0) return p;
    const double height = dot(n, p - sample->position) / length;
    return p + ((std::clamp(height, -most, most) - height) / length) * n;
  }

  Vec3 withinReach(std::int32_t v, const Vec3& to)
  {
    const Vec3 p = nearSamples(v, to);
    const double length = m_Complex.lengths[v], fineness = std::min(1.0, m_Options.fineLength / length);
    const double reach = std::min(0.3 * length, m_Options.farthest * fineness * std::sqrt(fineness));
    const Vec3 way = p - m_Start[v];
    const double distance = norm(way);
    return distance > reach ? m_Start[v] + (reach / distance) * way : p;
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const InterfaceMotionOptions& m_Options;
  const double m_Least;
  const std::vector<Vec3> m_Start;
  const std::map<Label, double> m_Volumes;
  MovingDual m_Dual;
  std::vector<TetComplex::FaceOfTet> m_Holders;     ///< per triangle of m_Dual: the face that holds its samples
  std::vector<std::array<std::int32_t, 2>> m_Along; ///< per point of m_Dual: neighbours on a curve, see findCurves
};

} // namespace

void moveInterfaceOfBlock(GuardedOperations& operations, const InterfaceMotionOptions& options)
{
  InterfaceMotion(operations, options).run();
}

} // namespace surgicalmesher
