// SPDX-License-Identifier: Apache-2.0
#include "GuardedOperations.h"
#include "TetQuality.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

constexpr int maximumRing = 10;

/// The best triangulation of a polygon of the ring of edge ab, each triangle of which makes a tetrahedron with either
/// end: by dynamic programming over its diagonals (G. Klincsek, Annals of Discrete Mathematics 9, 1980).
class RingTriangulation
{
public:
  /// `vertices`: of the whole ring; `weight`: of qualities in the label that the polygon lies in.
  RingTriangulation(const TetComplex& complex, std::int32_t a, std::int32_t b,
                    const std::vector<std::int32_t>& vertices, double weight, double minimumQuality)
    : m_A(a), m_B(b), m_Complex(complex), m_Vertices(vertices), m_Weight(weight), m_Minimum(minimumQuality)
  {
  }

  /// Finds the best one of the polygon from, from + 1, ..., to (ring numbers); false if none reaches the minimum.
  bool find(int from, int to)
  {
    m_From = from;
    for (int i = from; i < to; ++i) best(i, i + 1) = std::numeric_limits<double>::max();
    for (int gap = 2; gap <= to - from; ++gap)
      for (int i = from; i + gap <= to; ++i) choose(i, i + gap);
    return to - from < 2 || (best(from, to) != none && best(from, to) >= m_Minimum);
  }

  /// The tetrahedra of the polygon found between corners i and k.
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
  static constexpr double none = -1; ///< all are flat or wound negatively: no better than what may be there

  std::int32_t id(int i) const { return m_Vertices[i % m_Vertices.size()]; }
  const Vec3& at(int i) const { return m_Complex.points[id(i)]; }
  double& best(int i, int k) { return m_Best[i - m_From][k - m_From]; }

  /// The third corner of the triangle at diagonal ik.
  void choose(int i, int k)
  {
    double& value = best(i, k);
    value = none;
    for (int j = i + 1; j < k; ++j)
    {
      double q = std::min(best(i, j), best(j, k));
      if (q <= value || q < m_Minimum) continue;
      q = std::min(q, m_Weight * worstSine2(at(i), at(j), at(k), m_Complex.points[m_B]));
      if (q <= value || q < m_Minimum) continue;
      q = std::min(q, m_Weight * worstSine2(at(i), at(k), at(j), m_Complex.points[m_A]));
      if (q > value) value = q, m_Choice[i - m_From][k - m_From] = j;
    }
  }

  const std::int32_t m_A, m_B;
  const TetComplex& m_Complex;
  const std::vector<std::int32_t>& m_Vertices;
  const double m_Weight, m_Minimum;
  int m_From = 0;
  double m_Best[maximumRing + 1][maximumRing + 1];
  int m_Choice[maximumRing + 1][maximumRing + 1];
};

/// Where the labels change around an edge.
struct RingCuts
{
  int count = 0;
  int at[2] = { 0, 0 };
};

/// Nothing if they change more than twice.
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

bool GuardedOperations::removeEdge(std::int32_t a, std::int32_t b, std::int32_t seed, double minimumQuality)
{
  auto& c = m_Complex;
  if (m_Curves && m_Curves->isEdge(a, b)) return false;
  if (!c.ring(a, b, seed, m_Ring, m_RingVertices)) return false;
  const int n = int(m_Ring.size());
  if (n < 3 || n > maximumRing) return false;
  const std::optional<RingCuts> cuts = cutsOf(c, m_Ring);
  if (!cuts) return false;
  // Rotate so that the ring begins at a cut: one polygon inside a label, two on the sheet between two labels.
  const bool onSheet = cuts->count > 0;
  const int first = onSheet ? cuts->at[0] : 0, second = onSheet ? cuts->at[1] - cuts->at[0] : n - 1;
  if (onSheet && m_Envelope.isHeld()) return false;
  if (onSheet && (second < 2 || n - second < 2)) return false;
  std::rotate(m_Ring.begin(), m_Ring.begin() + first, m_Ring.end());
  std::rotate(m_RingVertices.begin(), m_RingVertices.begin() + first, m_RingVertices.end());

  std::vector<TetComplex::Tet> fresh;
  std::vector<Label> labels;
  const auto triangulate = [&](int from, int to)
  {
    const Label label = c.labels[m_Ring[from]];
    RingTriangulation triangulation(c, a, b, m_RingVertices, lenient(label, 1), minimumQuality);
    if (!triangulation.find(from, to)) return false;
    triangulation.tetrahedra(from, to, fresh);
    labels.resize(fresh.size(), label);
    return true;
  };
  m_Envelope.clear();
  if (!triangulate(0, second)) return false;
  if (onSheet)
  {
    if (!triangulate(second, n)) return false;
    for (int i : { 0, second })
      for (int k = 0; k < 4; ++k)
        if (c.neighbours[m_Ring[i]][k] == m_Ring[(i + n - 1) % n]) m_Envelope.addOldFace(m_Ring[i], k);
    const std::int32_t p = m_RingVertices[0], q = m_RingVertices[second];
    for (std::int32_t end : { a, b })
      m_Envelope.addNewFace(c.points[end], c.points[p], c.points[q], { end, p, q }, c.labels[m_Ring[0]],
                            c.labels[m_Ring[second]]);
    if (!m_Envelope.trianglesReach(minimumQuality) || !m_Envelope.featuresStay() || !m_Envelope.samplesStay())
      return false;
    m_Envelope.detach();
  }
  const auto ids = c.replace(m_Ring, fresh, labels);
  changed();
  m_Envelope.attach(ids);
  ++m_Counts.flips;
  m_Counts.t7 += onSheet;
  return true;
}

} // namespace surgicalmesher
