// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The measures that every guarded operation compares: the squared sines of a tetrahedron's worst dihedral angle and of
/// a triangle's smallest one.

#include "Vec3.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

/// min over the six edges of sin^2(dihedral angle), in [0, 8/9]; negative if abcd is flat or wound negatively. Small
/// and large angles count alike: 30 and 150 degrees both give 1/4. With V6 = 6 V and N the face normals of twice the
/// faces' area, sin(angle at e) = V6 |e| / (|N1| |N2|).
inline double worstSine2(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 ab = b - a, ac = c - a, ad = d - a;
  const Vec3 nd = cross(ab, ac);
  const double v6 = dot(nd, ad);
  if (!(v6 > 0)) return -1;
  const Vec3 nb = cross(ac, ad), nc = cross(ad, ab), na = nb + nc + nd;
  const double ia = 1 / squaredNorm(na), ib = 1 / squaredNorm(nb), ic = 1 / squaredNorm(nc), id = 1 / squaredNorm(nd);
  const double worst =
    std::min({ squaredNorm(ab) * ic * id, squaredNorm(ac) * ib * id, squaredNorm(ad) * ib * ic,
               squaredNorm(c - b) * ia * id, squaredNorm(d - b) * ia * ic, squaredNorm(d - c) * ia * ib });
  return v6 * v6 * worst;
}

/// sin^2 of the smallest angle of a triangle, in [0, 3/4]: that between its two longest sides, whose squared lengths
/// are among x, y and z; `area2` is the square of twice its area.
inline double smallestSine2(double area2, double x, double y, double z)
{
  const double least = x < y ? x : y, most = x < y ? y : x;
  return area2 / (most * (least < z ? z : least));
}

inline double smallestSine2(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return smallestSine2(squaredNorm(cross(b - a, c - a)), squaredNorm(b - a), squaredNorm(c - a), squaredNorm(c - b));
}

/// worstSine2 of a tetrahedron whose worst dihedral angle is `degrees` or 180 - `degrees`.
inline double sine2OfDegrees(double degrees)
{
  const double s = std::sin(degrees * 3.14159265358979323846 / 180);
  return s * s;
}

/// Dihedral angles, degrees, to which meshes are improved: usually, and where their features leave no room for that.
constexpr double usualAngle = 28.5;
constexpr double modestAngle = 23;

} // namespace surgicalmesher
