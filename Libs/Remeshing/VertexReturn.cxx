// SPDX-License-Identifier: Apache-2.0
#include "VertexReturn.h"

#include "Folds.h"
#include "GroupDescent.h"
#include "Quadric.h"

#include <algorithm>
#include <utility>

namespace surgicalmesher
{

namespace
{

class VertexReturn
{
public:
  VertexReturn(GuardedOperations& operations, const VertexReturnOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Good(sine2OfDegrees(options.goodAngle)), m_Group(operations, m_Good, ease)
  {
  }

  void run()
  {
    for (std::int32_t v = 0; v < std::int32_t(m_Complex.points.size()); ++v)
      if (m_Complex.vertexTet[v] >= 0 && m_Complex.onInterface[v] && !m_Complex.locked[v]) visit(v);
  }

private:
  void visit(std::int32_t v)
  {
    const Vec3 way = wayBack(v);
    if (norm(way) < std::max(m_Options.leastWay, m_Options.leastShare * m_Complex.lengths[v])) return;
    m_Group.setAround(v);
    const double before = m_Group.worst();
    if (!(before > 0)) return;
    findHinges();
    const double folded = foldedAround();
    for (const double share : { 1.0, 0.75, 0.5, 0.25 })
      if (isBack(v, share * way, before, folded)) return;
  }

  /// Returns the step to the least-squares fit, with a weak spring, as the samples do not determine the step along a
  /// flat sheet.
  Vec3 wayBack(std::int32_t v)
  {
    Quadric quadric = quadricOf(m_Complex, v, m_Operations.sheet(v), m_Options.robust, m_Operations.rigidity());
    quadric.addToDiagonal(0.005 * quadric.trace());
    return m_Operations.alongFeatures(v, quadric.solve(quadric.g));
  }

  bool isBack(std::int32_t v, const Vec3& way, double before, double folded)
  {
    constexpr double least = 0.05; // share of the worst quality before that must remain in between
    const Vec3 from = m_Complex.points[v];
    if (!m_Operations.move(v, from + way, least * before)) return false;
    // Folds are checked before the angles are mended, too, although mending would open one in forty.
    const auto isOpen = [&] { return isFine(v) || foldedAround() <= folded + rounding * norm(way); };
    if (isOpen() && mends(std::min(m_Good, before)) && isOpen()) return true;
    m_Group.takeBack();
    m_Operations.moveBack(v, from);
    m_Operations.reassignSamples(v);
    return false;
  }

  /// Moves the group until its worst quality is at least `wanted`; returns whether it is.
  bool mends(double wanted)
  {
    constexpr int rounds = 6;   // enough for 97 % of the groups that would succeed
    constexpr double hope = 2;  // most gain expected of a later round, in gains of the last one; loses one in twenty
    constexpr double dip = 0.5; // share of the quality after the return that must remain
    double now = m_Group.worst();
    const double floor = dip * now;
    for (int left = rounds; left > 0 && now < wanted && m_Group.step(floor); --left)
    {
      const double before = std::exchange(now, m_Group.worst());
      if (now + hope * (left - 1) * (now - before) < wanted) break;
    }
    return now >= wanted;
  }

  bool isFine(std::int32_t v) const { return m_Complex.lengths[v] < m_Options.foldsFrom; }

  void findHinges()
  {
    m_Hinges.clear();
    for (const std::int32_t v : m_Group.vertices())
      if (m_Complex.onInterface[v]) m_Hinges.add(m_Complex, m_Operations.sheet(v));
  }

  double foldedAround() { return foldedLength(m_Complex, m_Hinges.sorted()); }

  static constexpr double ease = 0.02; // as in PolishingOptions
  static constexpr double rounding = 1e-6;

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const VertexReturnOptions& m_Options;
  const double m_Good;
  GroupDescent m_Group;
  Hinges m_Hinges;
};

} // namespace

void returnVerticesOfBlock(GuardedOperations& operations, const VertexReturnOptions& options)
{
  VertexReturn(operations, options).run();
}

} // namespace surgicalmesher
