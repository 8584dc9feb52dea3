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

  /// Returns the mean of towardsTarget() over the neighbours of v. With spread = 1, this is a descent step of the sum
  /// of (|vx| - L)^2 over the neighbours x.
  Vec3 towardsMiddle(std::int32_t v)
  {
    const auto& neighbours = m_Operations.neighbours(v);
    Vec3 sum;
    for (const auto& n : neighbours) sum += towardsTarget(v, n.vertex);
    return sum / double(neighbours.size());
  }

  /// Returns the weighted mean of two steps of v: with weight `spread` the step along the edge vx to the target
  /// distance from x, and with weight 1 - spread the step to x itself, which evens out the directions of the edges.
  Vec3 towardsTarget(std::int32_t v, std::int32_t x) const
  {
    const Vec3 d = m_Complex.points[x] - m_Complex.points[v];
    const double target = m_Complex.targetLength(v, x);
    return (m_Options.spread * (1 - target / norm(d)) + 1 - m_Options.spread) * d;
  }

  /// Returns the least-squares step to the samples of the faces at v, with a spring to the middle of the neighbours on
  /// the interface.
  Vec3 onInterface(std::int32_t v)
  {
    Quadric quadric = quadricOf(m_Complex, v, m_Operations.sheet(v), m_Options.robust, m_Operations.rigidity());
    if (!(quadric.trace() > 0)) return {};
    const double spring = 0.05 * quadric.trace() / m_Options.fit;
    quadric.addToDiagonal(spring);
    return quadric.solve(quadric.g + spring * alongInterface(v));
  }

  /// Returns the step towards the middle of the neighbours on the same curve, or else on the sheet; zero where curves
  /// meet or end.
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
