#pragma once
/// The measure that every guarded operation compares: the squared sine of a tetrahedron's worst dihedral angle.

#include "Vec3.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

/// min over the six edges of sin^2(dihedral angle), in [0, 8/9]; negative if abcd is flat or wound negatively.
/// Small and large angles count alike: 30 and 150 degrees both give 1/4. With V6 = 6 V and N the face normals of twice the
/// faces' area, sin(angle at e) = V6 |e| / (|N1| |N2|).
inline double worstSine2(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 ab = b - a, ac = c - a, ad = d - a;
  const Vec3 nd = cross(ab, ac);
  const double v6 = dot(nd, ad);
  if (!(v6 > 0)) return -1;
  const Vec3 nb = cross(ac, ad), nc = cross(ad, ab), na = nb + nc + nd;
  const double ia = 1 / squaredNorm(na), ib = 1 / squaredNorm(nb), ic = 1 / squaredNorm(nc), id = 1 / squaredNorm(nd);
  const double worst = std::min({ squaredNorm(ab) * ic * id, squaredNorm(ac) * ib * id, squaredNorm(ad) * ib * ic,
                                  squaredNorm(c - b) * ia * id, squaredNorm(d - b) * ia * ic, squaredNorm(d - c) * ia * ib });
  return v6 * v6 * worst;
}

/// worstSine2 of a tetrahedron whose worst dihedral angle is `degrees` or 180 - `degrees`.
inline double sine2OfDegrees(double degrees)
{
  const double s = std::sin(degrees * 3.14159265358979323846 / 180);
  return s * s;
}

/// Degrees: what meshes are improved to, and what those are whose features leave no room for that.
constexpr double usualAngle = 28.5;
constexpr double modestAngle = 23;

} // namespace surgicalmesher
