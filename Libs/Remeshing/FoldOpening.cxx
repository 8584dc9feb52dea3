// SPDX-License-Identifier: Apache-2.0
#include "FoldOpening.h"

#include "Folds.h"
#include "TissueOffsets.h"
#include "VertexSteps.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

constexpr double degree = 3.14159265358979323846 / 180;

class FoldOpening
{
public:
  FoldOpening(GuardedOperations& operations, const FoldOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Good(sine2OfDegrees(options.goodAngle)),
      m_From(options.from)
  {
  }

  void run()
  {
    constexpr int rounds = 2;
    for (int round = 0; round < rounds; ++round)
      for (std::int32_t v = 0; v < std::int32_t(m_Complex.points.size()); ++v)
        if (m_Complex.vertexTet[v] >= 0 && m_Complex.onInterface[v] && isFree(v)) openAt(v);
  }

private:
  using Places = std::array<Vec3, 4>; ///< positions or steps of a hinge's vertices

  bool isFree(std::int32_t v) const { return !m_Complex.locked[v] && m_Complex.lengths[v] >= m_From; }

  /// Opens the folds at the edges of v. An edge with two free ends is treated only at the end with the smaller id.
  void openAt(std::int32_t v)
  {
    constexpr double widest = 128 * degree; // opening wider ones would move the interface too far from the boundary
    m_Hinges.clear();
    m_Hinges.add(m_Complex, m_Operations.sheet(v));
    for (const Hinge& h : m_Hinges.sorted())
    {
      if (h[0] != v && (h[1] != v || isFree(h[0]))) continue;
      const double turn = turnAt(m_Complex, h);
      if (turn > 90 * degree && turn < widest) open(h, turn);
    }
  }

  void open(const Hinge& h, double turn)
  {
    constexpr double aim = 86 * degree, farthest = 0.3; // farthest: target lengths
    const Places old = placesOf(h);
    Places ways;      // steps
    double opens = 0; // radians by which the unscaled steps change the angle
    m_Around.clear();
    for (int i = 0; i < 4; ++i)
    {
      m_Around.add(m_Complex, m_Operations.sheet(h[i]));
      if (!isFree(h[i])) continue;
      const Vec3 gradient = gradientOfTurn(h, i, turn);
      ways[i] = heldAt(m_Operations, h[i], ease).solve(gradient);
      opens += dot(ways[i], gradient);
    }
    if (!(opens > 0)) return;
    for (int i = 0; i < 4; ++i)
    {
      ways[i] = ((aim - turn) / opens) * ways[i];
      if (norm(ways[i]) > farthest * m_Complex.lengths[h[i]]) return;
    }
    const double before = foldedAround(), length = lengthAt(m_Complex, h);
    for (int i = 0; i < 4; ++i) moveAlong(m_Operations, h[i], ways[i], std::min(m_Good, m_Operations.qualityAt(h[i])));
    constexpr double worthwhile = 0.3;
    if (foldedAround() > before - worthwhile * length) takeBack(h, old);
  }

  Places placesOf(const Hinge& h) const
  {
    return { m_Complex.points[h[0]], m_Complex.points[h[1]], m_Complex.points[h[2]], m_Complex.points[h[3]] };
  }

  /// Returns the gradient of the angle with respect to the position of the hinge's vertex i, radians / mm.
  Vec3 gradientOfTurn(const Hinge& h, int i, double turn) const
  {
    const double step = 1e-4 * m_Complex.lengths[h[i]];
    Vec3& p = m_Complex.points[h[i]];
    const Vec3 at = p;
    Vec3 gradient;
    for (int k = 0; k < 3; ++k)
    {
      p[k] += step;
      gradient[k] = (turnAt(m_Complex, h) - turn) / step;
      p = at;
    }
    return gradient;
  }

  double foldedAround() { return foldedLength(m_Complex, m_Around.sorted()); }

  void takeBack(const Hinge& h, const Places& old)
  {
    const auto hasMoved = [&](int i) { return !(m_Complex.points[h[i]] == old[i]); };
    std::array<bool, 4> moved;
    for (int i = 3; i >= 0; --i)
      if ((moved[i] = hasMoved(i))) m_Operations.moveBack(h[i], old[i]);
    for (int i = 0; i < 4; ++i)
      if (moved[i]) m_Operations.reassignSamples(h[i]);
  }

  static constexpr double ease = 0.15; // see heldAt: how easily vertices leave their samples

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const double m_Good, m_From;
  Hinges m_Hinges, m_Around;
};

} // namespace

void openFoldsOfBlock(GuardedOperations& operations, const FoldOptions& options)
{
  FoldOpening(operations, options).run();
}

} // namespace surgicalmesher
