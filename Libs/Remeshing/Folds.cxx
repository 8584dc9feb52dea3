// SPDX-License-Identifier: Apache-2.0
#include "Folds.h"

#include "Bending.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace surgicalmesher
{

namespace
{

/// Returns the share, 0 to 1, of an edge's length that counts as folded. c and d are the vectors from the start of the
/// edge to the third corners of its triangles.
double foldedShare(const Vec3& edge, const Vec3& c, const Vec3& d)
{
  constexpr double cosine = 0.0698; // of 86 degrees
  const Vec3 n = cross(edge, c), m = cross(d, edge);
  const double sizes = std::sqrt(squaredNorm(n) * squaredNorm(m));
  return sizes > 0 ? std::clamp(0.5 - dot(n, m) / (2 * cosine * sizes), 0.0, 1.0) : 1;
}

} // namespace

void Hinges::add(const TetComplex& complex, const Sheet& sheet)
{
  forEachHinge(complex, sheet,
               [this](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
                 m_Hinges.push_back({ std::min(a, b), std::max(a, b), std::min(c, d), std::max(c, d) });
               });
}

const std::vector<Hinge>& Hinges::sorted()
{
  std::sort(m_Hinges.begin(), m_Hinges.end());
  m_Hinges.erase(std::unique(m_Hinges.begin(), m_Hinges.end()), m_Hinges.end());
  return m_Hinges;
}

double turnAt(const TetComplex& complex, const Hinge& hinge)
{
  const auto from = [&](int i) { return complex.points[hinge[i]] - complex.points[hinge[0]]; };
  return deflection(from(1), from(2), from(3));
}

double lengthAt(const TetComplex& complex, const Hinge& hinge)
{
  return norm(complex.points[hinge[1]] - complex.points[hinge[0]]);
}

double foldedAt(const TetComplex& complex, const Hinge& hinge)
{
  const auto from = [&](int i) { return complex.points[hinge[i]] - complex.points[hinge[0]]; };
  return lengthAt(complex, hinge) * foldedShare(from(1), from(2), from(3));
}

double foldedLength(const TetComplex& complex, const std::vector<Hinge>& hinges)
{
  return std::accumulate(hinges.begin(), hinges.end(), 0.0,
                         [&](double sum, const Hinge& h) { return sum + foldedAt(complex, h); });
}

double foldedMore(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet)
{
  const auto now = [&](std::int32_t x) { return complex.points[x]; };
  const auto then = [&](std::int32_t x) { return x == v ? p : complex.points[x]; };
  const auto folded = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
  { return norm(b - a) * foldedShare(b - a, c - a, d - a); };
  double sum = 0;
  forEachHinge(complex, sheet,
               [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
                 sum += hingeShare(v, c) *
                        (folded(then(a), then(b), then(c), then(d)) - folded(now(a), now(b), now(c), now(d)));
               });
  return sum;
}

} // namespace surgicalmesher
