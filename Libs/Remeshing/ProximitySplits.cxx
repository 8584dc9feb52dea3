// SPDX-License-Identifier: Apache-2.0
#include "ProximitySplits.h"

#include "Quadric.h"
#include "TetQuality.h"
#include "Triangle.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

class Proximity
{
public:
  Proximity(GuardedOperations& operations, const ProximityOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Least(sine2OfDegrees(options.leastAngle))
  {
  }

  void run()
  {
    for (int round = 0; round < m_Options.rounds; ++round)
      for (const Far& face : farFaces())
        if (isThere(face)) mend(face);
  }

private:
  struct Far
  {
    double excess; ///< squared distance over squared tolerance
    std::int32_t tet;
    int face;
    std::array<std::int32_t, 3> vertices;
  };

  /// Returns the largest ratio of squared distance to squared tolerance among the samples of the face.
  double excessOf(std::int32_t t, int face) const
  {
    const auto& x = m_Complex.tets[t];
    const auto at = [&](int k) { return m_Complex.points[x[(face + k) & 3]]; };
    double most = 0;
    for (std::int32_t e = m_Complex.sampleHeads[t][face]; e >= 0; e = m_Complex.samples[e].next)
    {
      const ListedSample& sample = m_Complex.samples[e];
      most =
        std::max(most, squaredDistanceToTriangle(sample.position, at(1), at(2), at(3)) / sample.squaredTolerance());
    }
    return most;
  }

  /// Returns the faces with a sample beyond its tolerance, worst first.
  std::vector<Far> farFaces() const
  {
    std::vector<Far> result;
    for (std::int32_t t = 0; t < std::int32_t(m_Complex.tets.size()); ++t)
      for (int i = 0; m_Complex.alive(t) && i < 4; ++i)
      {
        if (m_Complex.sampleHeads[t][i] < 0 || !m_Complex.isInterface(t, i)) continue;
        const auto& x = m_Complex.tets[t];
        if (const double excess = excessOf(t, i); excess > 1)
          result.push_back({ excess, t, i, { x[(i + 1) & 3], x[(i + 2) & 3], x[(i + 3) & 3] } });
      }
    std::stable_sort(result.begin(), result.end(), [](const Far& a, const Far& b) { return a.excess > b.excess; });
    return result;
  }

  bool isThere(const Far& f) const
  {
    if (!m_Complex.alive(f.tet) || !m_Complex.isInterface(f.tet, f.face)) return false;
    const auto& x = m_Complex.tets[f.tet];
    return f.vertices == std::array{ x[(f.face + 1) & 3], x[(f.face + 2) & 3], x[(f.face + 3) & 3] };
  }

  void mend(const Far& f)
  {
    for (const std::int32_t v : f.vertices) fit(v);
    const double excess = excessOf(f.tet, f.face);
    if (excess <= 1) return;
    int longest = -1;
    double most = 0;
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = f.vertices[k], b = f.vertices[(k + 1) % 3];
      const double length = norm(m_Complex.points[a] - m_Complex.points[b]);
      if (length < std::max(most, m_Options.shortest)) continue;
      most = length;
      longest = k;
    }
    if (longest >= 0) splitEdge(f, f.vertices[longest], f.vertices[(longest + 1) % 3], excess);
  }

  void splitEdge(const Far& f, std::int32_t a, std::int32_t b, double excess)
  {
    const Vec3 middle = 0.5 * (m_Complex.points[a] + m_Complex.points[b]);
    const auto v = m_Operations.split(a, b, f.tet, middle, std::min(m_Least, m_Operations.quality(f.tet) / 2));
    if (!v) return;
    fit(*v);
    double now = 0;
    for (const SheetFace& face : m_Operations.sheet(*v).faces)
      now = std::max(now, excessOf(face.holder.first, face.holder.second));
    if (now <= 0.9 * excess) return;
    if (!(m_Complex.points[*v] == middle)) m_Operations.moveBack(*v, middle);
    m_Operations.takeBackSplit(*v, a);
  }

  void fit(std::int32_t v)
  {
    constexpr double spring = 0.05;
    if (m_Complex.locked[v]) return;
    Quadric quadric = quadricOf(m_Complex, v, m_Operations.sheet(v), 0, 0);
    quadric.addToDiagonal(spring * quadric.trace());
    const Vec3 p = m_Complex.points[v], way = quadric.solve(quadric.g);
    const double floor = std::min(m_Least, m_Operations.qualityAt(v));
    for (const double share : { 1.0, 0.5, 0.25 })
      if (m_Operations.move(v, p + share * way, floor)) return;
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const ProximityOptions& m_Options;
  const double m_Least;
};

} // namespace

void meetProximityOfBlock(GuardedOperations& operations, const ProximityOptions& options)
{
  Proximity(operations, options).run();
}

} // namespace surgicalmesher
