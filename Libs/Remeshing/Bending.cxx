// SPDX-License-Identifier: Apache-2.0
#include "Bending.h"

#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Returns the cotangent of the angle between x and y.
double cotangent(const Vec3& x, const Vec3& y) { return dot(x, y) / norm(cross(x, y)); }

/// The energy of edge ab with the opposite corners c and d: |s_a a + s_b b - s_c c - s_d d|^2 / area.
struct Energy
{
  Vec3 bent;            ///< the sum in the norm
  double atA, atB, atC; ///< coefficients s with their sign
  double area;          ///< of both triangles together, twice

  Energy(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
  {
    const Vec3 edge = b - a;
    const double ca = cotangent(edge, c - a), cb = cotangent(-1.0 * edge, c - b);
    const double da = cotangent(edge, d - a), db = cotangent(-1.0 * edge, d - b);
    atA = cb + db;
    atB = ca + da;
    atC = -(ca + cb);
    bent = atA * a + atB * b + atC * c - (da + db) * d;
    area = norm(cross(edge, c - a)) + norm(cross(edge, d - a));
  }

  /// Returns the weight of |bent|^2 in the sum over all edges: less, the larger the present angle at the edge.
  double weight(const Vec3& edge) const
  {
    constexpr double sharp = 0.7; // radians
    return 1 / (area * (1 + squaredNorm(bent) / (squaredNorm(edge) * sharp * sharp)));
  }
};

} // namespace

std::int32_t cornerBeyond(const TetComplex& complex, const SheetFace& face, std::int32_t a, std::int32_t b)
{
  std::int32_t t = face.tet;
  int across = face.face;
  const Label other = complex.labels[complex.neighbours[t][across]];
  if (other == 0) // turn on the side of the background, where the outer surface continues
  {
    const std::int32_t n = complex.neighbours[t][across];
    for (int i = 0; i < 4; ++i)
      if (complex.neighbours[n][i] == t && !complex.contains(t, complex.tets[n][i])) across = i;
    t = n;
  }
  const bool isOuter = complex.labels[t] == 0;
  std::int32_t apex = complex.tets[t][across];
  for (;;)
  {
    const int next = complex.indexOf(t, complex.fourthVertex(t, a, b, apex)); // the other face at ab
    const std::int32_t n = complex.neighbours[t][next];
    if (n < 0) return -1;
    if (complex.labels[n] != complex.labels[t])
      return isOuter || labelPair(complex.labels[n], complex.labels[t]) == face.labels ? apex : -1;
    apex = complex.fourthVertex(n, a, b, apex);
    t = n;
  }
}

double deflection(const Vec3& edge, const Vec3& c, const Vec3& d)
{
  const Vec3 n = cross(edge, c), m = cross(d, edge);
  return std::atan2(norm(cross(n, m)), dot(n, m));
}

Quadric bendingOf(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet)
{
  Quadric quadric;
  const auto at = [&](std::int32_t x) { return x == v ? p : complex.points[x]; };
  forEachHinge(complex, sheet,
               [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d)
               {
                 const Energy hinge(at(a), at(b), at(c), at(d));
                 const double share = v == a ? hinge.atA : v == b ? hinge.atB : hinge.atC;
                 const double weight = hingeShare(v, c) * hinge.weight(at(b) - at(a));
                 quadric.addToDiagonal(weight * share * share);
                 quadric.g += (-weight * share) * hinge.bent;
               });
  return quadric;
}

} // namespace surgicalmesher
