// SPDX-License-Identifier: Apache-2.0
#include "EvenLengths.h"

#include "VertexSteps.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace surgicalmesher
{

namespace
{

class EvenLengths
{
public:
  EvenLengths(GuardedOperations& operations, const EdgeLengthOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Good(sine2OfDegrees(options.goodAngle)), m_IsTouched(m_Complex.points.size(), 0)
  {
  }

  void run()
  {
    forEachVertex([&](std::int32_t v) { stretchAt(v); });
    forEachVertex(
      [&](std::int32_t v)
      {
        if (m_IsTouched[v]) fitToSamples(v);
      });
  }

private:
  template <class F>
  void forEachVertex(const F& f)
  {
    for (std::int32_t v = 0; v < std::int32_t(m_Complex.points.size()); ++v)
      if (m_Complex.vertexTet[v] >= 0 && !m_Complex.locked[v] && m_Complex.onInterface[v] &&
          m_Complex.lengths[v] >= m_Options.from)
        f(v);
  }

  double ratio(std::int32_t a, std::int32_t b) const
  {
    return norm(m_Complex.points[a] - m_Complex.points[b]) / m_Complex.targetLength(a, b);
  }
  static bool isEven(double ratio) { return ratio >= shortestEven && ratio <= longestEven; }
  double floorAt(std::int32_t v) { return std::min(m_Good, m_Operations.qualityAt(v)); }

  /// Returns the number of edges at v with even lengths if v were at p; edges inside a label count insideLabel.
  double evenEdges(std::int32_t v, const Vec3& p)
  {
    double sum = 0;
    for (const auto& n : m_Operations.neighbours(v))
      if (isEven(norm(m_Complex.points[n.vertex] - p) / m_Complex.targetLength(v, n.vertex)))
        sum += n.alongInterface ? 1 : insideLabel;
    return sum;
  }

  void stretchAt(std::int32_t v)
  {
    constexpr double least = 0.4, most = 1.6; // beyond these, no single move suffices
    constexpr double ease = 0.02;
    std::optional<Quadric> held; // valid until v moves
    const auto neighbours = m_Operations.neighbours(v);
    for (const auto& n : neighbours)
    {
      if (!n.alongInterface) continue;
      const double r = ratio(v, n.vertex);
      if (r <= least || r >= most || isEven(r)) continue;
      if (!held) held = heldAt(m_Operations, v, ease);
      if (!stretch(v, n.vertex, r, *held)) continue;
      held.reset();
      touch(v);
    }
  }

  /// Marks v, which has moved, and its neighbours along the interface for fitToSamples().
  void touch(std::int32_t v)
  {
    m_IsTouched[v] = 1;
    for (const auto& n : m_Operations.neighbours(v))
      if (n.alongInterface) m_IsTouched[n.vertex] = 1;
  }

  /// Moves v so that its edge to u gets an even length.
  bool stretch(std::int32_t v, std::int32_t u, double ratio, const Quadric& held)
  {
    constexpr double margin = 0.005;
    const Vec3 p = m_Complex.points[v], edge = p - m_Complex.points[u];
    const bool isShort = ratio < shortestEven;
    const double lacking = isShort ? shortestEven + margin - ratio : ratio - longestEven + margin;
    const Vec3 direction = easiest(m_Operations, v, held, isShort ? edge : -1.0 * edge);
    const double along = std::abs(dot(direction, edge)) / norm(edge);
    if (along < 0.3) return false;
    for (const double times : { 1.0, 1.25 })
    {
      const Vec3 to = p + (times * lacking * m_Complex.targetLength(v, u) / along) * direction;
      const Outcome outcome = moveNear(v, onSheet(v, u, to), held);
      if (outcome != Outcome::tooNear) return outcome == Outcome::moved;
    }
    return false;
  }

  /// Returns the fit of v, were it at p, to its samples, moved only perpendicularly to the edge to u, so that the edge
  /// keeps its length.
  Vec3 onSheet(std::int32_t v, std::int32_t u, const Vec3& p)
  {
    Quadric quadric = quadricWith(m_Complex, v, p, m_Operations.sheet(v), m_Options.robust, m_Operations.rigidity());
    quadric.addToDiagonal(0.05 * quadric.trace());
    const Vec3 edge = p - m_Complex.points[u], free = quadric.solve(quadric.g);
    const Vec3 step = free - (dot(free, edge) / squaredNorm(edge)) * edge;
    const double length = norm(step), most = 0.3 * m_Complex.lengths[v];
    return p + (length > most ? most / length : 1) * step;
  }

  enum class Outcome
  {
    moved,
    refused,
    tooNear ///< angles are good, but lengths not even or samples against the move; a longer move may succeed
  };

  /// Moves v to p, or on from p in directions that improve its angles until they are good enough, if more lengths are
  /// even there.
  Outcome moveNear(std::int32_t v, Vec3 p, const Quadric& held)
  {
    constexpr int trials = 8;
    constexpr double hopeless = 0.1; // share of the required quality; from below it, one in 150 trials succeeds
    const double floor = floorAt(v), now = evenEdges(v, m_Complex.points[v]);
    if (!(evenEdges(v, p) > now)) return Outcome::refused;
    for (int trial = 0; trial <= trials; ++trial)
    {
      const double quality = m_Operations.qualityAt(v, p, -1);
      if (quality >= floor)
        return evenEdges(v, p) > now && m_Operations.moveWithin(v, p) ? Outcome::moved : Outcome::tooNear;
      if (quality < hopeless * floor) return Outcome::refused;
      p += (0.03 * m_Complex.lengths[v]) * easiest(m_Operations, v, held, uphill(m_Operations, v, p, quality));
    }
    return Outcome::refused;
  }

  /// Moves v to the least-squares fit to its samples, or part of the way, where that costs no even length.
  void fitToSamples(std::int32_t v)
  {
    Quadric quadric = quadricOf(m_Complex, v, m_Operations.sheet(v), m_Options.robust, m_Operations.rigidity());
    quadric.addToDiagonal(0.005 * quadric.trace());
    const Vec3 p = m_Complex.points[v], step = quadric.solve(quadric.g);
    if (isNegligible(step, m_Complex.lengths[v])) return;
    const double floor = floorAt(v), now = evenEdges(v, p);
    for (const double share : { 1.0, 0.5, 0.25 })
      if (evenEdges(v, p + share * step) >= now && m_Operations.move(v, p + share * step, floor)) return;
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const EdgeLengthOptions& m_Options;
  const double m_Good;
  std::vector<std::uint8_t> m_IsTouched; ///< vertices at which a length has changed
};

} // namespace

void evenLengthsOfBlock(GuardedOperations& operations, const EdgeLengthOptions& options)
{
  EvenLengths(operations, options).run();
}

} // namespace surgicalmesher
