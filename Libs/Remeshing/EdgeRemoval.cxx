// SPDX-License-Identifier: Apache-2.0
#include "Bending.h"
#include "GuardedOperations.h"
#include "MeshQuality.h"
#include "TetQuality.h"
#include "VertexSteps.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace surgicalmesher
{

namespace
{

constexpr int maximumRing = 10;

constexpr double none = -std::numeric_limits<double>::infinity();

/// Corners of a tetrahedron.
using Corners = std::array<const Vec3*, 4>;

// --- measures that a triangulation of the ring maximizes
/// The worst quality.
struct WorstCounts
{
  static constexpr double ofNothing = std::numeric_limits<double>::max();
  double joined(double x, double y) const { return std::min(x, y); }
  double with(double soFar, double quality, const Corners&) const { return std::min(soFar, quality); }
  bool mayExceed(double soFar, double best) const { return soFar > best; }
  const WorstCounts& inLabel(Label) const { return *this; }
};

/// The least height, mm, of the tetrahedra of tissues.
struct HeightCounts
{
  bool counts = true;
  static constexpr double ofNothing = std::numeric_limits<double>::max();
  double joined(double x, double y) const { return std::min(x, y); }
  double with(double soFar, double, const Corners& c) const
  {
    return counts ? std::min(soFar, leastHeight(*c[0], *c[1], *c[2], *c[3])) : soFar;
  }
  bool mayExceed(double soFar, double best) const { return soFar > best; }
  HeightCounts inLabel(Label label) const { return { label != 0 }; }
};

/// The sum over the tetrahedra of tissues of the sine of the worst dihedral angle less the usual sine, so that
/// additional tetrahedra do not count as a gain.
struct SumCounts
{
  double usualSine;
  double share = 1; ///< weight of the label: 0 for background
  static constexpr double ofNothing = 0;
  double joined(double x, double y) const { return x + y; }
  double with(double soFar, double quality, const Corners& = {}) const
  {
    return soFar + share * (std::sqrt(quality) - usualSine);
  }
  bool mayExceed(double soFar, double) const { return soFar > none; }
  SumCounts inLabel(Label label) const { return { usualSine, label == 0 ? 0.0 : 1.0 }; }
};

/// Finds the best triangulation of a polygon of ring vertices of edge ab, whose triangles each form a tetrahedron with
/// a and one with b: by dynamic programming over the diagonals (G. Klincsek, Annals of Discrete Mathematics 9, 1980).
template <class Measure>
class RingTriangulation
{
public:
  /// `vertices`: those of the whole ring; `weight`: factor on qualities in the label of the polygon (see lenient()).
  RingTriangulation(const TetComplex& complex, std::int32_t a, std::int32_t b,
                    const std::vector<std::int32_t>& vertices, double weight, double minimumQuality,
                    const Measure& measure)
    : m_A(a), m_B(b), m_Complex(complex), m_Vertices(vertices), m_Weight(weight),
      m_Minimum(std::max(0.0, minimumQuality)), m_Measure(measure)
  {
  }

  /// Returns the measure of the best triangulation of the polygon of ring vertices from, from + 1, ..., to; `none` if
  /// every triangulation has a tetrahedron below the minimum.
  double find(int from, int to)
  {
    m_From = from;
    for (int i = from; i < to; ++i) best(i, i + 1) = Measure::ofNothing;
    for (int gap = 2; gap <= to - from; ++gap)
      for (int i = from; i + gap <= to; ++i) choose(i, i + gap);
    return best(from, to);
  }

  /// Appends the tetrahedra of the triangulation found between ring vertices i and k.
  void tetrahedra(int i, int k, std::vector<TetComplex::Tet>& result) const
  {
    if (k - i < 2) return;
    const int j = m_Choice[i - m_From][k - m_From];
    result.push_back({ id(i), id(j), id(k), m_B });
    result.push_back({ id(i), id(k), id(j), m_A });
    tetrahedra(i, j, result);
    tetrahedra(j, k, result);
  }

private:
  std::int32_t id(int i) const { return m_Vertices[i % m_Vertices.size()]; }
  const Vec3& at(int i) const { return m_Complex.points[id(i)]; }
  double& best(int i, int k) { return m_Best[i - m_From][k - m_From]; }

  /// Chooses the third corner of the triangle at diagonal ik.
  void choose(int i, int k)
  {
    double& value = best(i, k);
    value = none;
    for (int j = i + 1; j < k; ++j)
    {
      double x = m_Measure.joined(best(i, j), best(j, k));
      if (!m_Measure.mayExceed(x, value)) continue;
      x = withTetrahedron(x, { &at(i), &at(j), &at(k), &m_Complex.points[m_B] });
      if (!m_Measure.mayExceed(x, value)) continue;
      x = withTetrahedron(x, { &at(i), &at(k), &at(j), &m_Complex.points[m_A] });
      if (x > value) value = x, m_Choice[i - m_From][k - m_From] = j;
    }
  }

  double withTetrahedron(double soFar, const Corners& c) const
  {
    const double quality = m_Weight * worstSine2(*c[0], *c[1], *c[2], *c[3]);
    return quality < m_Minimum ? none : m_Measure.with(soFar, quality, c);
  }

  const std::int32_t m_A, m_B;
  const TetComplex& m_Complex;
  const std::vector<std::int32_t>& m_Vertices;
  const double m_Weight, m_Minimum;
  const Measure m_Measure;
  int m_From = 0;
  double m_Best[maximumRing + 1][maximumRing + 1];
  int m_Choice[maximumRing + 1][maximumRing + 1];
};

/// The numbers in a ring of the tetrahedra that differ in label from the one before.
struct RingCuts
{
  int count = 0;
  int at[2] = { 0, 0 };
};

/// Returns nothing if the labels change more than twice.
std::optional<RingCuts> cutsOf(const TetComplex& complex, const std::vector<std::int32_t>& ring)
{
  RingCuts cuts;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    if (complex.labels[ring[i]] != complex.labels[ring[(i + n - 1) % n]])
    {
      if (cuts.count == 2) return {};
      cuts.at[cuts.count++] = int(i);
    }
  return cuts;
}

} // namespace

bool GuardedOperations::openRing(std::int32_t a, std::int32_t b, std::int32_t seed, int largest)
{
  const auto& c = m_Complex;
  if (m_Curves && m_Curves->isEdge(a, b)) return false;
  if (!c.ring(a, b, seed, m_Ring, m_RingVertices)) return false;
  const int n = int(m_Ring.size());
  if (n < 3 || n > largest) return false;
  const std::optional<RingCuts> cuts = cutsOf(c, m_Ring);
  if (!cuts) return false;
  m_RingIsOnSheet = cuts->count > 0;
  const int first = m_RingIsOnSheet ? cuts->at[0] : 0;
  m_RingEnd = m_RingIsOnSheet ? cuts->at[1] - cuts->at[0] : n - 1;
  if (m_RingIsOnSheet && (m_Envelope.isHeld() || m_RingEnd < 2 || n - m_RingEnd < 2)) return false;
  std::rotate(m_Ring.begin(), m_Ring.begin() + first, m_Ring.end());
  std::rotate(m_RingVertices.begin(), m_RingVertices.begin() + first, m_RingVertices.end());
  return true;
}

template <class Measure>
std::optional<double> GuardedOperations::fillRing(std::int32_t a, std::int32_t b, double minimumQuality,
                                                  const Measure& measure)
{
  m_Fresh.clear();
  m_FreshLabels.clear();
  double result = Measure::ofNothing;
  const auto fill = [&](int from, int to)
  {
    const Label label = m_Complex.labels[m_Ring[from]];
    RingTriangulation triangulation(m_Complex, a, b, m_RingVertices, lenient(label, 1), minimumQuality,
                                    measure.inLabel(label));
    const double found = triangulation.find(from, to);
    if (found == none) return false;
    result = measure.joined(result, found);
    triangulation.tetrahedra(from, to, m_Fresh);
    m_FreshLabels.resize(m_Fresh.size(), label);
    return true;
  };
  if (!fill(0, m_RingEnd)) return {};
  if (m_RingIsOnSheet && !fill(m_RingEnd, int(m_Ring.size()))) return {};
  return result;
}

/// Whether the envelope allows the interface edge ab to be flipped to the other diagonal of its two triangles.
bool GuardedOperations::mayFlipSheet(std::int32_t a, std::int32_t b, double minimumQuality)
{
  const auto& c = m_Complex;
  const int n = int(m_Ring.size());
  for (int i : { 0, m_RingEnd })
    for (int k = 0; k < 4; ++k)
      if (c.neighbours[m_Ring[i]][k] == m_Ring[(i + n - 1) % n]) m_Envelope.addOldFace(m_Ring[i], k);
  const std::int32_t p = m_RingVertices[0], q = m_RingVertices[m_RingEnd];
  for (std::int32_t end : { a, b })
    m_Envelope.addNewFace(c.points[end], c.points[p], c.points[q], { end, p, q },
                          labelPair(c.labels[m_Ring[0]], c.labels[m_Ring[m_RingEnd]]));
  return m_Envelope.trianglesReach(minimumQuality) && m_Envelope.featuresStay() && m_Envelope.samplesStay();
}

/// Replaces the ring by the tetrahedra that fillRing() has found, if the envelope allows it; m_Ring then lists these.
bool GuardedOperations::closeRing(std::int32_t a, std::int32_t b, double minimumQuality)
{
  m_Envelope.clear();
  if (m_RingIsOnSheet)
  {
    if (!mayFlipSheet(a, b, minimumQuality)) return false;
    m_Envelope.detach();
  }
  m_Ring = m_Complex.replace(m_Ring, m_Fresh, m_FreshLabels);
  changed();
  m_Envelope.attach(m_Ring);
  ++m_Counts.flips;
  m_Counts.t7 += m_RingIsOnSheet;
  return true;
}

bool GuardedOperations::removeEdge(std::int32_t a, std::int32_t b, std::int32_t seed,
                                   std::optional<double> minimumQuality)
{
  if (!openRing(a, b, seed, maximumRing)) return false;
  const double least = minimumQuality ? *minimumQuality : clearlyBetter(worstQuality(m_Ring));
  return fillRing(a, b, least, WorstCounts{}) && closeRing(a, b, least);
}

bool GuardedOperations::removeLowEdge(std::int32_t a, std::int32_t b, std::int32_t seed, double goodQuality)
{
  if (!openRing(a, b, seed, maximumRing)) return false;
  double least = goodQuality, lowest = HeightCounts::ofNothing;
  for (const std::int32_t t : m_Ring)
  {
    least = std::min(least, quality(t));
    const auto& x = m_Complex.tets[t];
    const auto at = [&](int i) { return &m_Complex.points[x[i]]; };
    lowest = HeightCounts().inLabel(m_Complex.labels[t]).with(lowest, 0, { at(0), at(1), at(2), at(3) });
  }
  const std::optional<double> height = fillRing(a, b, least, HeightCounts());
  return height && *height > 1.001 * lowest && closeRing(a, b, least);
}

bool GuardedOperations::swapEdge(std::int32_t a, std::int32_t b, std::int32_t seed, const SwapGoal& goal,
                                 SwapRefusals* refusals)
{
  constexpr int largest = 7; // swaps in larger rings hardly ever gain
  if (!openRing(a, b, seed, largest) || (refusals && refusals->contains(m_Complex, a, b, m_Ring))) return false;
  const std::optional<double> least = worthSwapping(a, b, goal);
  if (!least && refusals) refusals->add(m_Complex, seed, a, b);
  if (!least || !closeRing(a, b, *least)) return false;
  if (refusals) forgetAround(a, b, *refusals);
  return true;
}

/// Forgets refusals that the removal of edge ab may have made obsolete. After a flip on a sheet, these are all refusals
/// at its four corners: bending depends on the adjacent triangles, and staysBroad() on the number of triangles at a
/// vertex.
void GuardedOperations::forgetAround(std::int32_t a, std::int32_t b, SwapRefusals& refusals)
{
  refusals.forgetAt(m_Ring);
  if (!m_RingIsOnSheet) return;
  for (const std::int32_t v : { a, b, m_RingVertices[0], m_RingVertices[m_RingEnd] }) refusals.forgetAt(star(v));
}

/// Fills the open ring anew. Returns the least quality allowed for its tetrahedra, or nothing if the gain is too small.
std::optional<double> GuardedOperations::worthSwapping(std::int32_t a, std::int32_t b, const SwapGoal& goal)
{
  if (!m_RingIsOnSheet && m_Complex.labels[m_Ring[0]] == 0) return {};
  const SumCounts measure{ goal.usualSine };
  double before = 0, least = goal.goodQuality;
  for (const std::int32_t t : m_Ring)
  {
    const double q = m_Complex.quality(t);
    least = std::min(least, m_RingIsOnSheet ? quality(t) : q);
    before = measure.inLabel(m_Complex.labels[t]).with(before, std::max(0.0, q));
  }
  const std::optional<double> after = fillRing(a, b, least, measure);
  if (!after) return {};
  double gain = *after - before;
  if (m_RingIsOnSheet) gain += goal.smoothness * flatterBy(a, b);
  if (gain <= goal.leastGain || (m_RingIsOnSheet && !staysBroad(a, b))) return {};
  return goal.sparesWhole && ringHasWhole() ? std::nullopt : std::optional(least);
}

/// Whether a vertex of the ring isWhole(); misses vertices on a block's border, whose star is incomplete. The ends of
/// the edge need no test: a swap is only tried for mediocre tetrahedra and on the interface.
bool GuardedOperations::ringHasWhole()
{
  return std::any_of(m_RingVertices.begin(), m_RingVertices.end(), [&](std::int32_t v) { return isWhole(*this, v); });
}

/// Whether both ends of the interface edge ab keep four triangles or more: a vertex with three triangles is a peak,
/// which the measure of bending favours because it has few edges.
bool GuardedOperations::staysBroad(std::int32_t a, std::int32_t b)
{
  constexpr std::size_t broad = 4;
  const auto trianglesAt = [&](std::int32_t v) { return interfaceFaces(v).size(); };
  return trianglesAt(a) > broad && trianglesAt(b) > broad;
}

/// Returns by how much flipping the interface edge ab reduces bending: angles, radians, times edge lengths, in target
/// lengths.
double GuardedOperations::flatterBy(std::int32_t a, std::int32_t b) const
{
  const auto& c = m_Complex;
  const std::int32_t p = m_RingVertices[0], q = m_RingVertices[m_RingEnd];
  const auto faceAt = [&](int i)
  {
    const std::int32_t t = m_Ring[i], before = m_Ring[(i + m_Ring.size() - 1) % m_Ring.size()];
    SheetFace face{ t, 0, labelPair(c.labels[t], c.labels[before]), {}, {} };
    while (c.neighbours[t][face.face] != before) ++face.face;
    return face;
  };
  const auto bent = [&](std::int32_t x, std::int32_t y, std::int32_t one, std::int32_t other)
  {
    const Vec3& from = c.points[x];
    const Vec3 edge = c.points[y] - from;
    return norm(edge) * deflection(edge, c.points[one] - from, c.points[other] - from);
  };
  double change = bent(a, b, p, q) - bent(p, q, a, b);
  for (const auto& [face, apex, other] : { std::tuple(faceAt(0), p, q), std::tuple(faceAt(m_RingEnd), q, p) })
    for (const auto& [end, opposite] : { std::pair(a, b), std::pair(b, a) })
      if (const std::int32_t beyond = cornerBeyond(c, face, end, apex); beyond >= 0)
        change += bent(end, apex, opposite, beyond) - bent(end, apex, other, beyond);
  return change / c.targetLength(a, b);
}

} // namespace surgicalmesher
