// SPDX-License-Identifier: Apache-2.0
#include "Coarsening.h"

#include "Quadric.h"
#include "TetQuality.h"

#include <algorithm>
#include <deque>

namespace surgicalmesher
{

namespace
{

/// Priority queue by classes of relative length, first in, first out within each class: nearly sorted at constant cost.
class LengthQueue
{
public:
  void push(std::int32_t v, double ratio) { m_Buckets[std::min(31, int(ratio * 32))].push_back(v); }
  bool pop(std::int32_t& v)
  {
    for (auto& bucket : m_Buckets)
      if (!bucket.empty())
      {
        v = bucket.front();
        bucket.pop_front();
        return true;
      }
    return false;
  }

private:
  std::array<std::deque<std::int32_t>, 32> m_Buckets;
};

struct Near
{
  double ratio; ///< edge length over min(level, target length)
  std::int32_t vertex;
  bool alongInterface;
};

class BlockCoarsening
{
public:
  BlockCoarsening(GuardedOperations& operations, double level, const CoarseningOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Level(level), m_Options(options),
      m_Low(sine2OfDegrees(options.minimumAngle)), m_Good(sine2OfDegrees(options.goodAngle)),
      m_Queued(m_Complex.points.size(), 0), m_Tries(m_Complex.points.size(), 0)
  {
  }

  void run()
  {
    std::vector<float> shortest(m_Complex.points.size(), 1e9f);
    for (std::int32_t t = 0; t < std::int32_t(m_Complex.tets.size()); ++t)
    {
      if (!m_Complex.alive(t)) continue;
      const auto& x = m_Complex.tets[t];
      for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
        {
          const float r = float(ratio(x[i], x[j]));
          shortest[x[i]] = std::min(shortest[x[i]], r);
          shortest[x[j]] = std::min(shortest[x[j]], r);
        }
    }
    for (std::int32_t v = 0; v < std::int32_t(shortest.size()); ++v)
      if (!m_Complex.locked[v] && shortest[v] < m_Options.shortEdge) push(v, shortest[v]);
    for (std::int32_t v; m_Queue.pop(v);)
    {
      m_Queued[v] = 0;
      if (m_Complex.vertexTet[v] >= 0) visit(v);
    }
  }

private:
  /// Returns the length of ab over its target if less than shortEdge, else shortEdge.
  double ratio(std::int32_t a, std::int32_t b) const
  {
    const double target = std::min(m_Level, m_Complex.targetLength(a, b));
    const double length2 = squaredNorm(m_Complex.points[a] - m_Complex.points[b]), limit = m_Options.shortEdge * target;
    return length2 < limit * limit ? std::sqrt(length2) / target : m_Options.shortEdge;
  }

  void push(std::int32_t v, double r)
  {
    constexpr int mostTries = 4; // at one level; later levels try again
    if (m_Queued[v] || m_Complex.locked[v] || m_Tries[v] >= mostTries) return;
    m_Queued[v] = 1;
    m_Queue.push(v, r);
  }

  /// Fills m_Near with the neighbours of v nearer than shortEdge, nearest first.
  void shortNeighbours(std::int32_t v)
  {
    m_Near.clear();
    for (const auto& n : m_Operations.neighbours(v))
      if (const double r = ratio(v, n.vertex); r < m_Options.shortEdge)
        m_Near.push_back({ r, n.vertex, n.alongInterface });
    std::sort(m_Near.begin(), m_Near.end(),
              [](const Near& a, const Near& b)
              { return a.ratio != b.ratio ? a.ratio < b.ratio : a.vertex < b.vertex; });
  }

  /// Restricts m_Near to the neighbours into which a vertex of the interface may be merged.
  void keepOnlyAlongInterface()
  {
    m_Near.erase(std::remove_if(m_Near.begin(), m_Near.end(), [](const Near& n) { return !n.alongInterface; }),
                 m_Near.end());
  }

  struct Candidate
  {
    double quality;
    std::int32_t vertex;
    Vec3 position;
  };

  /// Merges u into a near neighbour: the nearest one that leaves good angles, else the one that leaves the best angles.
  void visit(std::int32_t u)
  {
    if (!m_Operations.mayCoarsen(u)) return;
    ++m_Tries[u];
    shortNeighbours(u);
    if (m_Complex.onInterface[u]) keepOnlyAlongInterface();
    const Vec3 from = m_Complex.points[u];
    m_Candidates.clear();
    bool fits = false;
    for (double share : { 1.0, 0.5, 0.0, 0.75, 0.25 })
    {
      if ((share == 0 && !m_Options.thorough) || (share == 0.75 && !m_Options.quarters)) break;
      if (share == 0.5) fits = m_Options.fit && quadricAt(u).trace() > 0;
      for (const Near& n : m_Near)
      {
        if (!m_Operations.mayCollapse(u, n.vertex, share < 1)) continue;
        const Vec3 to = m_Complex.points[n.vertex];
        Vec3 p = share == 1 ? to : from + share * (to - from);
        if (share == 0.5 && fits) p = fitted(u, n.vertex, p);
        const double q = m_Operations.qualityAfterCollapse(u, n.vertex, p, m_Low, m_Options.longEdge);
        if (q < m_Low) continue;
        if (q >= m_Good && collapse(u, { q, n.vertex, p })) return;
        if (q < m_Good) m_Candidates.push_back({ q, n.vertex, p });
      }
    }
    std::stable_sort(m_Candidates.begin(), m_Candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.quality > b.quality; });
    for (const Candidate& c : m_Candidates)
      if (collapse(u, c)) return;
  }

  /// Returns the normal equations m x = g of the samples for the position x of v (quadricOf() has them for the step);
  /// cached until a collapse changes a face at v.
  const Quadric& quadricAt(std::int32_t v)
  {
    m_Quadrics.resize(m_Complex.points.size());
    auto& [isKnown, quadric] = m_Quadrics[v];
    if (isKnown) return quadric;
    gatherSheet(m_Complex, m_Operations.interfaceFacesOfTarget(v), m_Sheet);
    quadric = quadricOf(m_Complex, v, m_Sheet, 0, m_Operations.rigidity());
    quadric.g += quadric.times(m_Complex.points[v]);
    isKnown = true;
    return quadric;
  }

  /// Returns the least-squares fit of the merged vertex to the samples of u and v, held to `middle`, the middle of the
  /// edge, by a weak spring; `middle` itself if the fit is farther from it than v.
  Vec3 fitted(std::int32_t u, std::int32_t v, const Vec3& middle)
  {
    Quadric both = quadricAt(v);
    if (!(both.trace() > 0)) return middle;
    const Quadric& ofU = quadricAt(u);
    for (int k = 0; k < 6; ++k) both.m[k] += ofU.m[k];
    both.g += ofU.g;
    const double spring = 0.02 * both.trace();
    both.addToDiagonal(spring);
    Vec3 p = both.solve(both.g + spring * middle);
    if (m_Operations.watchesFeatures()) p = middle + m_Operations.alongFeatures(u, p - middle);
    return squaredNorm(p - middle) < squaredNorm(m_Complex.points[v] - middle) ? p : middle;
  }

  bool collapse(std::int32_t u, const Candidate& c)
  {
    if (!m_Options.thorough) m_Around = m_Operations.neighbours(u);
    if (!m_Operations.collapseWithin(u, c.vertex, c.position, m_Low)) return false;
    if (m_Complex.onInterface[u]) forgetQuadrics(c.vertex);
    if (m_Options.thorough) wakeAll(c.vertex);
    else wakeChanged(c.vertex);
    return true;
  }

  void forgetQuadrics(std::int32_t v)
  {
    if (m_Quadrics.empty()) return;
    m_Quadrics[v].isKnown = false;
    for (const auto& n : m_Operations.neighbours(v)) m_Quadrics[n.vertex].isKnown = false;
  }

  /// Queues v, and the ends m_Around of the edges that a collapse onto v has changed: these may have become short or
  /// removable.
  void wakeChanged(std::int32_t v)
  {
    double least = m_Options.shortEdge;
    for (const auto& n : m_Around)
    {
      if (n.vertex == v) continue;
      const double r = ratio(v, n.vertex);
      if (r < m_Options.shortEdge) push(n.vertex, r);
      least = std::min(least, r);
    }
    push(v, least);
  }

  /// Queues v and all of its near neighbours.
  void wakeAll(std::int32_t v)
  {
    shortNeighbours(v);
    if (m_Near.empty()) return;
    push(v, m_Near[0].ratio);
    for (const Near& n : m_Near) push(n.vertex, n.ratio);
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const double m_Level;
  const CoarseningOptions& m_Options;
  const double m_Low, m_Good;
  std::vector<std::uint8_t> m_Queued, m_Tries;
  LengthQueue m_Queue;
  std::vector<Near> m_Near;
  std::vector<GuardedOperations::Neighbour> m_Around;
  std::vector<Candidate> m_Candidates;
  struct KnownQuadric
  {
    bool isKnown = false;
    Quadric quadric;
  };
  std::vector<KnownQuadric> m_Quadrics; ///< per vertex; empty until the first is needed
  Sheet m_Sheet;
};

} // namespace

void coarsenBlock(GuardedOperations& operations, double level, const CoarseningOptions& options)
{
  BlockCoarsening(operations, level, options).run();
}

} // namespace surgicalmesher
