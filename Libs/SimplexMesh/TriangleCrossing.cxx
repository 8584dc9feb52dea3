// SPDX-License-Identifier: Apache-2.0
#include "TriangleCrossing.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

constexpr double kRounding = 1e-9; ///< tolerance, relative to lengths

/// Whether two segments in a common plane with normal n intersect or come within rounding error of each other.
bool segmentsMeet(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& n)
{
  const auto side = [&](const Vec3& from, const Vec3& to, const Vec3& x) { return dot(cross(to - from, x - from), n); };
  const double tolerance = kRounding * squaredNorm(n);
  const double p1 = side(a, b, p), q1 = side(a, b, q), a1 = side(p, q, a), b1 = side(p, q, b);
  if (std::min(p1, q1) > tolerance || std::max(p1, q1) < -tolerance) return false;
  if (std::min(a1, b1) > tolerance || std::max(a1, b1) < -tolerance) return false;
  if (std::abs(p1) > tolerance || std::abs(q1) > tolerance) return true;
  const Vec3 along = b - a; // all four points are collinear
  const double from = dot(p - a, along), to = dot(q - a, along), rounding = kRounding * squaredNorm(along);
  return std::max(from, to) >= -rounding && std::min(from, to) <= squaredNorm(along) + rounding;
}

bool inside(const Vec3& x, const std::array<Vec3, 3>& t, const Vec3& n)
{
  const double tolerance = -kRounding * squaredNorm(n);
  for (int k = 0; k < 3; ++k)
    if (dot(cross(t[(k + 1) % 3] - t[k], x - t[k]), n) < tolerance) return false;
  return true;
}

bool segmentMeetsTriangle(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t)
{
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double sp = dot(p - t[0], n), sq = dot(q - t[0], n);
  const double tolerance = kRounding * norm(n) * (norm(q - p) + std::sqrt(norm(n)));
  if (std::min(sp, sq) > tolerance || std::max(sp, sq) < -tolerance) return false;
  if (std::abs(sp) > tolerance || std::abs(sq) > tolerance) return inside(p + sp / (sp - sq) * (q - p), t, n);
  if (inside(p, t, n) || inside(q, t, n)) return true;
  for (int k = 0; k < 3; ++k)
    if (segmentsMeet(p, q, t[k], t[(k + 1) % 3], n)) return true;
  return false;
}

/// Whether two triangles with the common edge ij and the apexes k and m are folded onto each other.
bool folded(const Vec3& i, const Vec3& j, const Vec3& k, const Vec3& m)
{
  const Vec3 edge = j - i;
  const auto away = [&](const Vec3& x) { return x - i - dot(x - i, edge) / squaredNorm(edge) * edge; };
  const Vec3 u = away(k), v = away(m);
  return dot(u, v) > 0.99 * norm(u) * norm(v);
}

} // namespace

bool trianglesCross(const CornerTriangle& a, const CornerTriangle& b)
{
  std::array<bool, 3> sharedA{}, sharedB{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (a.ids[i] == b.ids[j]) sharedA[i] = sharedB[j] = true;
  const auto shared = std::count(sharedA.begin(), sharedA.end(), true);
  if (shared == 3) return true;
  const auto firstOf = [](const std::array<bool, 3>& flags, bool value)
  { return int(std::find(flags.begin(), flags.end(), value) - flags.begin()); };
  if (shared == 2)
  {
    const int k = firstOf(sharedA, false);
    return folded(a.corners[(k + 1) % 3], a.corners[(k + 2) % 3], a.corners[k], b.corners[firstOf(sharedB, false)]);
  }
  const auto edgesMeet = [](const CornerTriangle& of, const std::array<bool, 3>& isShared, const CornerTriangle& with)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      if (!isShared[i] && !isShared[j] && segmentMeetsTriangle(of.corners[i], of.corners[j], with.corners)) return true;
    }
    return false;
  };
  return edgesMeet(a, sharedA, b) || edgesMeet(b, sharedB, a);
}

} // namespace surgicalmesher
