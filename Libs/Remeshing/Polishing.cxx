// SPDX-License-Identifier: Apache-2.0
#include "Polishing.h"

#include "TetQuality.h"
#include "VertexSteps.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

class Polishing
{
public:
  Polishing(GuardedOperations& operations, const PolishingOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Good(sine2OfDegrees(options.goodAngle))
  {
  }

  void run()
  {
    for (std::int32_t v = 0; v < std::int32_t(m_Complex.points.size()); ++v)
    {
      if (m_Complex.vertexTet[v] < 0 || m_Complex.locked[v]) continue;
      if (m_Options.sparesWhole && isWhole(m_Operations, v)) continue;
      if (m_Complex.onInterface[v]) moveToSamples(v);
      if (m_Options.climbs) climb(v);
    }
  }

private:
  void moveToSamples(std::int32_t v)
  {
    Quadric quadric = quadricOf(m_Complex, v, m_Operations.sheet(v), m_Options.robust, m_Operations.rigidity());
    quadric.addToDiagonal(0.05 * quadric.trace() / m_Options.fit);
    const Vec3 step = m_Operations.alongFeatures(v, quadric.solve(quadric.g));
    if (isNegligible(step, m_Complex.lengths[v]) || norm(step) < m_Options.leastWay) return;
    const double before = m_Operations.qualityAt(v);
    for (double share : { 1.0, 0.5, 0.25 })
      if (m_Operations.move(v, m_Complex.points[v] + share * step, share < 0.5 ? before : std::min(m_Good, before)))
        return;
  }

  /// Returns the sum, over the tissues' tetrahedra and the triangles at v, of the sines of their worst angles with v at
  /// p; -1 if a quality is below `floor`.
  double sumOfSines(std::int32_t v, const Vec3& p, double floor)
  {
    double sum = 0;
    StarQuality& star = m_Operations.measured(v);
    const std::vector<double>& qualities = star.each(p);
    for (std::size_t i = 0; i < star.size(); ++i)
    {
      if (qualities[i] < floor) return -1;
      if (!star.isBackground(i)) sum += std::sqrt(std::max(0.0, qualities[i]));
    }
    return sum;
  }

  void climb(std::int32_t v)
  {
    const Vec3 p = m_Complex.points[v];
    const double size = m_Complex.lengths[v], h = 1e-4 * size;
    const double floor = std::min(m_Good, m_Operations.qualityAt(v));
    const double now = sumOfSines(v, p, -1);
    Vec3 direction;
    for (int a = 0; a < 3; ++a)
    {
      Vec3 q = p;
      q[a] += h;
      direction[a] = sumOfSines(v, q, -1) - now;
    }
    direction = easiest(m_Operations, v, heldAt(m_Operations, v, m_Options.ease), direction);
    for (double step : { 0.12, 0.06, 0.03 })
    {
      const Vec3 q = p + step * size * direction;
      if (sumOfSines(v, q, floor) > now && m_Operations.moveWithin(v, q)) return;
    }
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const PolishingOptions& m_Options;
  const double m_Good;
};

} // namespace

void polishBlock(GuardedOperations& operations, const PolishingOptions& options)
{
  Polishing(operations, options).run();
}

} // namespace surgicalmesher
