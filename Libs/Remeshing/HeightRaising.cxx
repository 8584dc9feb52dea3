// SPDX-License-Identifier: Apache-2.0
#include "HeightRaising.h"

#include "FaceAdjacency.h"
#include "MeshQuality.h"
#include "Parallel.h"
#include "TetQuality.h"
#include "VertexSteps.h"

#include <algorithm>
#include <limits>
#include <map>

namespace surgicalmesher
{

namespace
{

class HeightRaising
{
public:
  HeightRaising(GuardedOperations& operations, const HeightOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Good(sine2OfDegrees(options.goodAngle))
  {
  }

  void run()
  {
    std::vector<double> heights = heightsInTissues();
    findLimits(heights);
    for (int pass = 0; pass < m_Options.passes; ++pass)
    {
      if (pass > 0) heights = heightsInTissues();
      bool any = false;
      for (const auto& [height, t] : lowTetrahedra(heights))
        if (m_Complex.alive(t) && heightOf(t) < limitOf(t))
          any = (collapseAnEdge(t) || removeAnEdge(t) || moveVertices(t)) || any;
      if (!any) return;
    }
  }

private:
  using Low = std::pair<double, std::int32_t>;

  static constexpr double outside = std::numeric_limits<double>::infinity();

  /// Returns the least height of each tetrahedron; `outside` in the background.
  std::vector<double> heightsInTissues() const
  {
    std::vector<double> result(m_Complex.tets.size(), outside);
    parallelForIfIdle(result.size(),
                      [&](std::size_t n)
                      {
                        const auto t = std::int32_t(n);
                        if (m_Complex.alive(t) && m_Complex.labels[t] != 0) result[n] = heightOf(t);
                      });
    return result;
  }

  /// Limits the heights that count as low, by label: if more than a few tetrahedra of a tissue are low, the tissue
  /// itself is thin.
  void findLimits(const std::vector<double>& heights)
  {
    constexpr double few = 0.03; // share; 0.1 inflates a spinal cord that is hardly wider than L by 4 %
    std::map<Label, std::vector<double>> heightsOf;
    for (std::size_t t = 0; t < heights.size(); ++t)
      if (heights[t] != outside) heightsOf[m_Complex.labels[t]].push_back(heights[t]);
    for (auto& [label, each] : heightsOf)
    {
      const auto at = each.begin() + std::ptrdiff_t(few * double(each.size()));
      std::nth_element(each.begin(), at, each.end());
      m_Limits[label] = std::min(m_Options.height, *at);
    }
  }
  double limitOf(std::int32_t t) const { return m_Limits[m_Complex.labels[t]]; }

  /// Returns the tetrahedra to process in this pass, lowest first.
  std::vector<Low> lowTetrahedra(const std::vector<double>& heights) const
  {
    std::vector<Low> low;
    for (std::int32_t t = 0; t < std::int32_t(heights.size()); ++t)
      if (heights[t] < limitOf(t)) low.push_back({ heights[t], t });
    const auto most = std::max<std::size_t>(100, std::size_t(m_Options.worstShare * double(m_Complex.tets.size())));
    std::sort(low.begin(), low.end());
    low.resize(std::min(low.size(), most));
    return low;
  }

  double heightOf(std::int32_t t) const { return heightWith(t, -1, {}); }

  /// Returns the least height of t with vertex v at p.
  double heightWith(std::int32_t t, std::int32_t v, const Vec3& p) const
  {
    const auto& x = m_Complex.tets[t];
    const auto at = [&](int i) -> const Vec3& { return x[i] == v ? p : m_Complex.points[x[i]]; };
    return leastHeight(at(0), at(1), at(2), at(3));
  }

  /// Returns the least height of the tissues' tetrahedra at v, with v at p, except those that contain `without`.
  double leastAt(std::int32_t v, const Vec3& p, std::int32_t without = -1)
  {
    double least = std::numeric_limits<double>::max();
    for (const std::int32_t t : m_Operations.star(v))
      if (m_Complex.labels[t] != 0 && (without < 0 || !m_Complex.contains(t, without)))
        least = std::min(least, heightWith(t, v, p));
    return least;
  }

  double floorAt(std::int32_t v) { return std::min(m_Good, m_Operations.qualityAt(v)); }

  bool collapseAnEdge(std::int32_t t)
  {
    const auto x = m_Complex.tets[t];
    for (const auto& e : kEdgeCorners)
      for (const auto& [u, v] : { std::pair(x[e[0]], x[e[1]]), std::pair(x[e[1]], x[e[0]]) })
        if (collapseInto(u, v)) return true;
    return false;
  }

  bool collapseInto(std::int32_t u, std::int32_t v)
  {
    if (m_Complex.locked[u] || !m_Operations.mayCollapse(u, v, false)) return false;
    const Vec3& p = m_Complex.points[v];
    return leastAt(u, p, v) > 1.001 * leastAt(u, m_Complex.points[u]) &&
           m_Operations.collapse(u, v, p, floorAt(u), m_Options.longEdge);
  }

  bool removeAnEdge(std::int32_t t)
  {
    const auto x = m_Complex.tets[t];
    return std::any_of(kEdgeCorners.begin(), kEdgeCorners.end(),
                       [&](const auto& e) { return m_Operations.removeLowEdge(x[e[0]], x[e[1]], t, m_Good); });
  }

  bool moveVertices(std::int32_t t)
  {
    const auto x = m_Complex.tets[t];
    bool any = false;
    for (const std::int32_t v : x)
    {
      if (!m_Complex.locked[v] && !isTip(v) && climb(v)) any = true;
      if (any && heightOf(t) >= limitOf(t)) return true;
    }
    return any;
  }

  /// An interface vertex with three triangles could move far between their samples, which would make a dent or a spike.
  bool isTip(std::int32_t v) { return m_Operations.interfaceFaces(v).size() == 3; }

  /// Returns a direction that raises the lowest tetrahedra at v: the sum of the unit gradients of the heights of all
  /// that are nearly as low as `least`.
  Vec3 uphill(std::int32_t v, double least)
  {
    const Vec3 p = m_Complex.points[v];
    const double h = 1e-5 * m_Complex.lengths[v];
    Vec3 sum;
    for (const std::int32_t t : m_Operations.star(v))
    {
      if (m_Complex.labels[t] == 0) continue;
      const double height = heightWith(t, v, p);
      if (height > 1.1 * least) continue;
      Vec3 gradient;
      for (int axis = 0; axis < 3; ++axis)
      {
        Vec3 q = p;
        q[axis] += h;
        gradient[axis] = heightWith(t, v, q) - height;
      }
      if (const double n = norm(gradient); n > 0) sum += gradient / n;
    }
    return sum;
  }

  bool climb(std::int32_t v)
  {
    const double size = m_Complex.lengths[v], floor = floorAt(v);
    double least = leastAt(v, m_Complex.points[v]), step = 0.12 * size;
    const double start = least;
    const Quadric held = heldAt(m_Operations, v, 0.02);
    for (int trial = 0; trial < m_Options.trials && least < m_Options.height && step > 0.004 * size; ++trial)
    {
      const Vec3 way = trial % 3 == 2 ? m_Directions.next() : uphill(v, least);
      const Vec3 q = m_Complex.points[v] + step * easiest(m_Operations, v, held, way);
      const double after = leastAt(v, q);
      if (after > least && m_Operations.move(v, q, floor))
      {
        least = after;
        step *= 1.3;
      }
      else step *= 0.8;
    }
    return least > start * (1 + 1e-3);
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const HeightOptions& m_Options;
  const double m_Good;
  std::vector<double> m_Limits = std::vector<double>(labelCount); ///< mm, by label; see HeightOptions::height
  Directions m_Directions;
};

} // namespace

void raiseHeightsOfBlock(GuardedOperations& operations, const HeightOptions& options)
{
  HeightRaising(operations, options).run();
}

} // namespace surgicalmesher
