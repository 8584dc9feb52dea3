// SPDX-License-Identifier: Apache-2.0
#include "Relaxation.h"

#include "TetQuality.h"
#include "VertexSteps.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

class Relaxation
{
public:
  Relaxation(GuardedOperations& operations, const RelaxationOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Good(sine2OfDegrees(options.goodAngle))
  {
  }

  void run()
  {
    for (std::int32_t v = 0; v < std::int32_t(m_Complex.points.size()); ++v)
      if (m_Complex.vertexTet[v] >= 0 && !m_Complex.locked[v]) relax(v);
  }

private:
  void relax(std::int32_t v)
  {
    const Vec3 step = m_Operations.alongFeatures(v, m_Complex.onInterface[v] ? onInterface(v) : towardsMiddle(v));
    const double before = m_Operations.qualityAt(v);
    const double floor = std::min(m_Good, before);
    for (double share : { 1.0, 0.5, 0.25 })
      if (m_Operations.move(v, m_Complex.points[v] + share * step, share < 0.5 ? before : floor)) return;
  }

  /// Where the edges at v would like it: the mean, over its neighbours x, of the point at the target distance from x in
  /// the direction of v. A descent step of the sum of (|vx| - L)^2.
  Vec3 towardsMiddle(std::int32_t v)
  {
    const auto& neighbours = m_Operations.neighbours(v);
    Vec3 sum;
    for (const auto& n : neighbours) sum += towardsTarget(v, n.vertex);
    return sum / double(neighbours.size());
  }

  /// The way of v towards (for x too far) or from (for x too near) its target distance to x, and half the way to x
  /// itself, which evens out the directions.
  Vec3 towardsTarget(std::int32_t v, std::int32_t x) const
  {
    const Vec3 d = m_Complex.points[x] - m_Complex.points[v];
    const double target = m_Complex.targetLength(v, x);
    return (m_Options.spread * (1 - target / norm(d)) + 1 - m_Options.spread) * d;
  }

  /// Least squares over the samples of the faces at v, held by a spring to the middle of the neighbours on the
  /// interface.
  Vec3 onInterface(std::int32_t v)
  {
    Quadric quadric = quadricOf(m_Complex, v, m_Operations.sheet(v), m_Options.robust, m_Operations.rigidity());
    if (!(quadric.trace() > 0)) return {};
    const double spring = 0.05 * quadric.trace() / m_Options.fit;
    quadric.addToDiagonal(spring);
    return quadric.solve(quadric.g + spring * alongInterface(v));
  }

  /// Towards the middle of the neighbours on the same curve, or on the sheet; nothing where curves meet.
  Vec3 alongInterface(std::int32_t v)
  {
    facesAtNeighbours(m_Operations.sheet(v), v, m_Degree);
    const auto curves = std::count_if(m_Degree.begin(), m_Degree.end(), [](const auto& d) { return d.second > 2; });
    if (curves != 0 && curves != 2) return {};
    Vec3 sum;
    double total = 0;
    for (const auto& [u, degree] : m_Degree)
    {
      if (curves && degree <= 2) continue;
      sum += towardsTarget(v, u);
      total += 1;
    }
    return sum / total;
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const RelaxationOptions& m_Options;
  const double m_Good;
  FacesAtNeighbours m_Degree;
};

} // namespace

void relaxBlock(GuardedOperations& operations, const RelaxationOptions& options)
{
  Relaxation(operations, options).run();
}

} // namespace surgicalmesher
