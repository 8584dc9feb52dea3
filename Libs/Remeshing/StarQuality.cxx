// SPDX-License-Identifier: Apache-2.0
#include "StarQuality.h"

#include "TetQuality.h"

#include <algorithm>
#include <limits>

// Compiles a second copy of a function for processors with AVX2, chosen when the program starts. Both copies give the
// same bits, since AVX2 alone has no fused multiply-add. Not with sanitisers, which are not initialised yet at that
// moment.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) &&                           \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define WITH_WIDE_COPY __attribute__((target_clones("avx2", "default")))
#else
#define WITH_WIDE_COPY
#endif

namespace surgicalmesher
{

namespace
{

double lesser(double a, double b) { return a < b ? a : b; }

} // namespace

void StarQuality::gather(const TetComplex& complex, std::int32_t v, const std::vector<std::int32_t>& star,
                         const std::vector<TetComplex::FaceOfTet>& triangles, double triangleWeight)
{
  // The other three corners, in an order such that (v, others) is an even permutation of the tetrahedron.
  static constexpr int others[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 3, 0, 1 }, { 2, 1, 0 } };
  m_Size = star.size();
  m_Groups.resize((m_Size + lanes - 1) / lanes);
  for (std::size_t i = 0; i < m_Groups.size() * lanes; ++i)
  {
    Group& group = m_Groups[i / lanes];
    const std::size_t lane = i % lanes;
    const std::int32_t t = star[i < m_Size ? i : i - lane];
    const auto& x = complex.tets[t];
    const int* order = others[complex.indexOf(t, v)];
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t id = x[order[k]]; // NOLINT(clang-analyzer-core.CallAndMessage): v is a vertex of t
      const Vec3& p = complex.points[id];
      group.corners[k][0][lane] = p.x;
      group.corners[k][1][lane] = p.y;
      group.corners[k][2][lane] = p.z;
      group.ids[k][lane] = id;
    }
    group.weight[lane] = complex.labels[t] == 0 ? backgroundLeniency : 1;
  }
  m_Triangles.clear();
  m_TriangleCount = 0;
  m_TriangleWeight = triangleWeight;
  if (triangleWeight > 0) gatherTriangles(complex, v, triangles);
}

void StarQuality::gatherTriangles(const TetComplex& complex, std::int32_t v,
                                  const std::vector<TetComplex::FaceOfTet>& triangles)
{
  const auto put = [&](std::size_t lane, const std::array<std::int32_t, 2>& ids)
  {
    for (int k = 0; k < 2; ++k)
    {
      const Vec3& p = complex.points[ids[k]];
      for (int axis = 0; axis < 3; ++axis) m_Triangles.back().corners[k][axis][lane] = p[axis];
      m_Triangles.back().ids[k][lane] = ids[k];
    }
  };
  for (const auto& [t, i] : triangles)
  {
    const auto& x = complex.tets[t];
    std::array<std::int32_t, 2> others;
    for (int k = 0, found = 0; k < 4; ++k)
      if (k != i && x[k] != v) others[found++] = x[k];
    const std::size_t lane = m_TriangleCount++ % lanes;
    if (lane == 0) m_Triangles.emplace_back();
    for (std::size_t l = lane; l < lanes; ++l) put(l, others);
  }
}

/// worstSine2 (TetQuality.h) without a branch and with one division.
inline void StarQuality::measure(const Group& g, const Vec3& p, double* quality)
{
  for (std::size_t k = 0; k < lanes; ++k)
  {
    const auto edgeTo = [&](int corner) {
      return Vec3{ g.corners[corner][0][k], g.corners[corner][1][k], g.corners[corner][2][k] } - p;
    };
    const Vec3 b = edgeTo(0), c = edgeTo(1), d = edgeTo(2);
    const Vec3 nd = cross(b, c), nb = cross(c, d), nc = cross(d, b);
    const double v6 = dot(nd, d);
    const double na2 = squaredNorm(nb + nc + nd), nb2 = squaredNorm(nb), nc2 = squaredNorm(nc), nd2 = squaredNorm(nd);
    const double ab = na2 * nb2, cd = nc2 * nd2;
    const double least = lesser(lesser(lesser(squaredNorm(b) * ab, squaredNorm(c) * (na2 * nc2)),
                                       lesser(squaredNorm(d) * (na2 * nd2), squaredNorm(c - b) * (nb2 * nc2))),
                                lesser(squaredNorm(d - b) * (nb2 * nd2), squaredNorm(d - c) * cd));
    const double q = v6 > 0 ? g.weight[k] * (v6 * v6 * least / (ab * cd)) : -1;
    quality[k] = q > 0 ? q : -1; // q is NaN if a face has no area but rounding leaves a volume
  }
}

inline void StarQuality::measure(const Triangles& g, const Vec3& p, double* quality) const
{
  for (std::size_t k = 0; k < lanes; ++k)
  {
    const Vec3 b = Vec3{ g.corners[0][0][k], g.corners[0][1][k], g.corners[0][2][k] } - p;
    const Vec3 c = Vec3{ g.corners[1][0][k], g.corners[1][1][k], g.corners[1][2][k] } - p;
    quality[k] =
      m_TriangleWeight * smallestSine2(squaredNorm(cross(b, c)), squaredNorm(b), squaredNorm(c), squaredNorm(c - b));
  }
}

/// Returns the lesser of `worst` and the least quality that `measure` finds in the groups, or some value below
/// `atLeast`.
template <class Groups, class Measure>
inline double StarQuality::worstOf(const Groups& groups, double without, double atLeast, double worst,
                                   Measure&& measure)
{
  for (const auto& g : groups)
  {
    double q[lanes];
    measure(g, q);
    for (const auto& ids : g.ids)
      for (std::size_t k = 0; k < lanes; ++k) q[k] = ids[k] == without ? std::numeric_limits<double>::max() : q[k];
    worst = lesser(worst, lesser(lesser(q[0], q[1]), lesser(q[2], q[3])));
    if (worst < atLeast) break;
  }
  return worst;
}

WITH_WIDE_COPY
double StarQuality::worst(const Vec3& p, double atLeast, std::int32_t without) const
{
  const auto ofGroup = [&](const auto& group, double* quality) { measure(group, p, quality); };
  const double worst = worstOf(m_Groups, without, atLeast, std::numeric_limits<double>::max(), ofGroup);
  return worst < atLeast ? worst : worstOf(m_Triangles, without, atLeast, worst, ofGroup);
}

WITH_WIDE_COPY
const std::vector<double>& StarQuality::each(const Vec3& p)
{
  m_Each.resize((m_Groups.size() + m_Triangles.size()) * lanes);
  for (std::size_t i = 0; i < m_Groups.size(); ++i) measure(m_Groups[i], p, m_Each.data() + i * lanes);
  // Triangles overwrite the padding of the last group of tetrahedra.
  for (std::size_t i = 0; i < m_Triangles.size(); ++i) measure(m_Triangles[i], p, m_Each.data() + m_Size + i * lanes);
  return m_Each;
}

/// Adds the unit gradients of the qualities that are at most `most` to `sum`. Most groups have none and are measured
/// only once.
template <class Groups, class Measure>
inline void StarQuality::addGradients(const Groups& groups, std::size_t size, const Vec3& p, double h, double most,
                                      Measure&& measure, Vec3& sum)
{
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    double now[lanes], moved[3][lanes];
    measure(groups[i], p, now);
    if (lesser(lesser(now[0], now[1]), lesser(now[2], now[3])) > most) continue;
    for (int axis = 0; axis < 3; ++axis)
    {
      Vec3 q = p;
      q[axis] += h;
      measure(groups[i], q, moved[axis]);
    }
    for (std::size_t k = 0; k < std::min(lanes, size - i * lanes); ++k)
    {
      const Vec3 gradient{ moved[0][k] - now[k], moved[1][k] - now[k], moved[2][k] - now[k] };
      if (const double n = norm(gradient); n > 0 && now[k] <= most) sum += gradient / n;
    }
  }
}

WITH_WIDE_COPY
Vec3 StarQuality::sumOfGradients(const Vec3& p, double h, double most) const
{
  const auto ofGroup = [&](const auto& group, const Vec3& at, double* quality) { measure(group, at, quality); };
  Vec3 sum;
  addGradients(m_Groups, m_Size, p, h, most, ofGroup, sum);
  addGradients(m_Triangles, m_TriangleCount, p, h, most, ofGroup, sum);
  return sum;
}

} // namespace surgicalmesher
