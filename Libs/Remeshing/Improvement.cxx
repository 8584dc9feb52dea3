// SPDX-License-Identifier: Apache-2.0
#include "Improvement.h"

#include "FaceAdjacency.h"
#include "GroupDescent.h"
#include "Parallel.h"
#include "TetQuality.h"
#include "VertexSteps.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace surgicalmesher
{

namespace
{

/// Success rate of a costly operation, which is abandoned once it succeeds too seldom.
class Chance
{
public:
  bool isFair() const { return m_Tries < enough || m_Successes * onceIn >= m_Tries; }
  bool note(bool success)
  {
    ++m_Tries;
    if (success) ++m_Successes;
    return success;
  }

private:
  static constexpr std::size_t enough = 60, onceIn = 25;
  std::size_t m_Tries = 0, m_Successes = 0;
};

class Improvement
{
public:
  Improvement(GuardedOperations& operations, const ImprovementOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Target(sine2OfDegrees(options.targetAngle)), m_Group(operations, m_Target, options.ease)
  {
  }

  void run()
  {
    m_Touched.assign(m_Complex.points.size(), 1);
    m_IsStuck.assign(m_Complex.points.size(), 0);
    for (int pass = 0; pass < m_Options.passes; ++pass)
    {
      const std::vector<std::int32_t> bad = worstFirst();
      if (bad.empty()) break;
      m_Touched.assign(m_Complex.points.size(), 0);
      m_TogetherLeft = m_Options.together > 0 ? shareOf(m_Options.togetherShare) : 0;
      if (pass == 0) m_IsCrowded = double(bad.size()) > m_Options.crowd * double(m_Complex.tets.size());
      if (!improveAll(bad)) break;
    }
  }

private:
  /// Returns the tetrahedra below the target quality near which something has changed, at most the share worstShare.
  std::vector<std::int32_t> worstFirst() const
  {
    std::vector<std::pair<double, std::int32_t>> bad;
    const std::vector<double> qualities = qualitiesOfTouched();
    for (std::int32_t t = 0; t < std::int32_t(qualities.size()); ++t)
      if (qualities[t] < m_Target) bad.push_back({ qualities[t], t });
    std::sort(bad.begin(), bad.end());
    std::vector<std::int32_t> result;
    for (std::size_t n = 0; n < std::min(bad.size(), shareOf(m_Options.worstShare)); ++n)
      result.push_back(bad[n].second);
    return result;
  }

  /// Returns whether another pass is worthwhile.
  bool improveAll(const std::vector<std::int32_t>& bad)
  {
    constexpr double worthwhile = 0.3; // share of the tetrahedra that reached the target
    std::size_t tried = 0, mended = 0;
    for (const std::int32_t t : bad)
    {
      if (isMended(t)) continue;
      ++tried;
      improve(t);
      mended += isMended(t);
    }
    return !m_IsCrowded || double(mended) >= worthwhile * double(tried);
  }

  /// A deleted tetrahedron counts as mended: those that replace it are examined in the next pass.
  bool isMended(std::int32_t t) const { return !m_Complex.alive(t) || m_Operations.quality(t) >= m_Target; }

  std::size_t shareOf(double share) const
  {
    return std::max<std::size_t>(100, std::size_t(share * double(m_Complex.tets.size())));
  }

  /// Returns the quality of each tetrahedron; infinity where nothing has changed.
  std::vector<double> qualitiesOfTouched() const
  {
    std::vector<double> result(m_Complex.tets.size(), std::numeric_limits<double>::infinity());
    parallelForIfIdle(result.size(),
                      [&](std::size_t n)
                      {
                        const auto t = std::int32_t(n);
                        if (m_Complex.alive(t) && isTouched(t)) result[n] = m_Operations.quality(t);
                      });
    return result;
  }

  /// Returns whether anything near t has changed since t was last tried.
  bool isTouched(std::int32_t t) const
  {
    const auto& x = m_Complex.tets[t];
    return m_Touched[x[0]] || m_Touched[x[1]] || m_Touched[x[2]] || m_Touched[x[3]];
  }

  void touch(std::int32_t v)
  {
    m_Touched[v] = 1;
    m_IsStuck[v] = 0;
  }

  void touchStar(std::int32_t v)
  {
    m_Touched.resize(m_Complex.points.size(), 1); // v may be a new vertex from a split
    m_IsStuck.resize(m_Complex.points.size(), 0);
    for (std::int32_t t : m_Operations.star(v))
      for (std::int32_t x : m_Complex.tets[t]) touch(x);
  }

  void improve(std::int32_t t)
  {
    double quality = m_Operations.quality(t);
    for (int left = 3; left >= 0; --left)
    {
      const bool done = removeAnEdge(t) || moveAVertex(t) || collapseAnEdge(t) || (m_Options.split && splitAnEdge(t)) ||
                        moveTogether(t) || splitAndMoveTogether(t);
      if (!done || isMended(t)) return;
      const double before = std::exchange(quality, m_Operations.quality(t));
      if (m_IsCrowded && quality + left * (quality - before) < m_Target) return;
    }
  }

  template <class F>
  bool forEachEdge(std::int32_t t, F&& f)
  {
    const auto x = m_Complex.tets[t];
    for (const auto& e : kEdgeCorners)
      if (f(x[e[0]], x[e[1]])) return true;
    return false;
  }

  bool removeAnEdge(std::int32_t t)
  {
    return forEachEdge(t,
                       [&](std::int32_t a, std::int32_t b)
                       {
                         if (m_Complex.locked[a] && m_Complex.locked[b]) return false;
                         if (!m_Operations.removeEdge(a, b, t)) return false;
                         touch(a);
                         touch(b);
                         for (const std::int32_t v : m_Operations.ringVertices()) touch(v);
                         return true;
                       });
  }

  bool moveAVertex(std::int32_t t)
  {
    const auto x = m_Complex.tets[t];
    bool any = false;
    for (std::int32_t v : x)
    {
      if (optimise(v)) any = true;
      if (any && m_Operations.quality(t) >= m_Target) return true;
    }
    return any;
  }

  /// Improves the worst quality at v by steps along the summed gradients of its worst tetrahedra and in random
  /// directions.
  bool optimise(std::int32_t v)
  {
    constexpr double first = 0.12, least = 0.004; // steps, shares of L; 0.01 leaves worse angles at traced curves
    if (m_Complex.locked[v] || (m_IsCrowded && m_IsStuck[v])) return false;
    double best = m_Operations.qualityAt(v);
    const double start = best;
    const double size = m_Complex.lengths[v];
    double step = first * size;
    const Quadric held = heldAt(m_Operations, v, m_Options.ease);
    Vec3 up; // from v's present position
    bool knowsUphill = false;
    for (int trial = 0; trial < m_Options.trials && best < m_Target && step > least * size; ++trial)
    {
      const Vec3 p = m_Complex.points[v];
      const bool isRandom = trial % 3 == 2;
      if (!isRandom && !std::exchange(knowsUphill, true))
        up = easiest(m_Operations, v, held, uphill(m_Operations, v, p, best));
      const Vec3 q = p + step * (isRandom ? easiest(m_Operations, v, held, m_Directions.next()) : up);
      if (m_Operations.qualityAt(v, q, best) > best && m_Operations.moveWithin(v, q))
      {
        best = m_Operations.qualityAt(v);
        knowsUphill = false;
        step *= 1.3;
      }
      else step *= 0.8;
    }
    m_IsStuck[v] = !(best > start * (1 + 1e-3));
    if (m_IsStuck[v]) return false;
    touchStar(v);
    return true;
  }

  /// Moves the vertices around t together, where no single vertex can move without making another tetrahedron the
  /// worst. The moves are kept if the worst quality around these vertices has improved.
  bool moveTogether(std::int32_t t)
  {
    struct Range
    {
      double near; ///< tetrahedra whose quality is at most this multiple of t's take part
      double dip;  ///< share of the group's initial quality to which it may fall in between
      Chance& chance;
    };
    if (m_TogetherLeft == 0) return false;
    --m_TogetherLeft;
    for (const Range& range : { Range{ 1.3, 0.8, m_NearTogether }, Range{ 2, 0.6, m_FarTogether } })
    {
      if (!range.chance.isFair()) continue;
      m_Group.set(neighbourhood(t, range.near));
      const double before = m_Group.worst();
      if (before > 0 && range.chance.note(moveTogether(before, range.dip))) return true;
    }
    return false;
  }

  /// Moves the group until it is better than `before`; its quality never falls below dip * before. Takes the moves back
  /// and returns false without success.
  bool moveTogether(double before, double dip)
  {
    double after = m_Group.worst();
    for (int round = 0; round < m_Options.together && after < m_Target; ++round)
    {
      if (!m_Group.step(dip * before)) break;
      after = m_Group.worst();
      if (round + 1 == m_Options.patience && !(after > before)) break;
    }
    if (after > before * (1 + 1e-3))
    {
      for (std::int32_t v : m_Group.vertices()) touchStar(v);
      return true;
    }
    m_Group.takeBack();
    return false;
  }

  /// Splits an edge of t in the middle and moves the vertices around the new one together, for places where there are
  /// too few vertices for good angles, as around a tiny body. Undone if that does not help.
  bool splitAndMoveTogether(std::int32_t t)
  {
    if (!m_Options.split || m_TogetherLeft == 0 || !m_SplitTogether.isFair()) return false;
    const auto x = m_Complex.tets[t];
    return forEachEdge(t,
                       [&](std::int32_t a, std::int32_t b)
                       {
                         if (m_Complex.locked[a]) std::swap(a, b);
                         if (m_Complex.locked[a]) return false;
                         const auto& star = m_Operations.star(a); // an undone split gives t another number
                         const auto isT = [&](std::int32_t s)
                         { return std::is_permutation(x.begin(), x.end(), m_Complex.tets[s].begin()); };
                         return splitAndMoveTogether(a, b, *std::find_if(star.begin(), star.end(), isT));
                       });
  }

  bool splitAndMoveTogether(std::int32_t a, std::int32_t b, std::int32_t seed)
  {
    constexpr double dip = 0.3;
    const double before = std::min(m_Operations.qualityAt(a), m_Operations.qualityAt(b));
    const Vec3 middle = 0.5 * (m_Complex.points[a] + m_Complex.points[b]);
    const auto v = before > 0 ? m_Operations.split(a, b, seed, middle, dip * before) : std::nullopt;
    if (!v) return false;
    m_Group.setAround(*v);
    if (m_SplitTogether.note(moveTogether(before, dip))) return true;
    m_Operations.takeBackSplit(*v, a);
    return false;
  }

  /// Returns the unlocked vertices of the tetrahedra that share a vertex with t and have at most `near` times its
  /// quality.
  std::vector<std::int32_t> neighbourhood(std::int32_t t, double near)
  {
    const double limit = near * m_Operations.quality(t);
    std::vector<std::int32_t> result;
    for (std::int32_t v : m_Complex.tets[t])
      for (std::int32_t s : m_Operations.star(v))
        if (m_Operations.quality(s) <= limit)
          for (std::int32_t x : m_Complex.tets[s])
            if (!m_Complex.locked[x]) result.push_back(x);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  bool collapseAnEdge(std::int32_t t)
  {
    return forEachEdge(t,
                       [&](std::int32_t a, std::int32_t b)
                       {
                         const double length = norm(m_Complex.points[a] - m_Complex.points[b]);
                         if (length > m_Options.shortEdge * m_Complex.targetLength(a, b)) return false;
                         for (const auto& [u, v] : { std::pair(a, b), std::pair(b, a) })
                         {
                           if (m_Complex.locked[u]) continue;
                           const double better = clearlyBetter(m_Operations.qualityAt(u));
                           const Vec3 from = m_Complex.points[u], to = m_Complex.points[v];
                           for (double share : { 1.0, 0.5 })
                             if (m_Operations.collapse(u, v, from + share * (to - from), better, m_Options.longEdge))
                             {
                               touchStar(v);
                               return true;
                             }
                         }
                         return false;
                       });
  }

  bool splitAnEdge(std::int32_t t)
  {
    return forEachEdge(t,
                       [&](std::int32_t a, std::int32_t b)
                       {
                         if (m_Complex.locked[a] && m_Complex.locked[b]) return false;
                         const double length = norm(m_Complex.points[a] - m_Complex.points[b]);
                         if (length < m_Options.splitEdge * m_Complex.targetLength(a, b)) return false;
                         if (!m_Complex.ring(a, b, t, m_Ring, m_RingVertices)) return false;
                         return splitAtBest(a, b, t);
                       });
  }

  /// Splits ab at the point where the halves of the ring's tetrahedra are best, if they are better than the ring is
  /// now.
  bool splitAtBest(std::int32_t a, std::int32_t b, std::int32_t seed)
  {
    const double before = m_Operations.worstQuality(m_Ring);
    const auto halves = [&](const Vec3& p)
    {
      double worst = std::numeric_limits<double>::max();
      for (std::int32_t t : m_Ring)
      {
        const double w = m_Complex.labels[t] == 0 ? backgroundLeniency : 1;
        worst = std::min({ worst, w * m_Complex.qualityWith(t, a, p), w * m_Complex.qualityWith(t, b, p) });
        if (worst <= 0) break;
      }
      return worst;
    };
    Vec3 p = 0.5 * (m_Complex.points[a] + m_Complex.points[b]);
    double best = halves(p);
    double step = 0.2 * norm(m_Complex.points[a] - m_Complex.points[b]);
    for (int trial = 0; trial < 16; ++trial)
    {
      const Vec3 q = p + step * m_Directions.next();
      if (const double value = halves(q); value > best) best = value, p = q;
      else step *= 0.85;
    }
    const double better = clearlyBetter(before);
    const auto v = best > better ? m_Operations.split(a, b, seed, p, better) : std::nullopt;
    if (!v) return false;
    touchStar(*v);
    return true;
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const ImprovementOptions& m_Options;
  const double m_Target;
  Directions m_Directions;
  GroupDescent m_Group;
  std::vector<std::uint8_t> m_Touched; ///< per vertex
  std::vector<std::uint8_t> m_IsStuck; ///< per vertex: no better position was found, and nothing near has changed since
  bool m_IsCrowded = false;            ///< see ImprovementOptions::crowd
  std::size_t m_TogetherLeft = 0;      ///< group moves left in this pass
  Chance m_NearTogether, m_FarTogether, m_SplitTogether;
  std::vector<std::int32_t> m_Ring, m_RingVertices;
};

} // namespace

void improveBlock(GuardedOperations& operations, const ImprovementOptions& options)
{
  Improvement(operations, options).run();
}

} // namespace surgicalmesher
