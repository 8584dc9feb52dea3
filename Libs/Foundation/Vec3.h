// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points and vectors of the meshing core: three doubles, millimetres unless a docstring says otherwise.

#include <cmath>

namespace surgicalmesher
{

struct Vec3
{
  double x = 0, y = 0, z = 0;

  double& operator[](int axis) { return (&x)[axis]; }
  double operator[](int axis) const { return (&x)[axis]; }
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return { a.x + b.x, a.y + b.y, a.z + b.z }; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return { a.x - b.x, a.y - b.y, a.z - b.z }; }
inline Vec3 operator-(const Vec3& a) { return { -a.x, -a.y, -a.z }; }
inline Vec3 operator*(const Vec3& a, double s) { return { a.x * s, a.y * s, a.z * s }; }
inline Vec3 operator*(double s, const Vec3& a) { return a * s; }
inline Vec3 operator/(const Vec3& a, double s) { return a * (1 / s); }
inline Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
inline Vec3& operator-=(Vec3& a, const Vec3& b) { return a = a - b; }
inline bool operator==(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
inline double squaredNorm(const Vec3& a) { return dot(a, a); }
inline double norm(const Vec3& a) { return std::sqrt(squaredNorm(a)); }

/// Six times the signed volume of tetrahedron abcd, positive when d sees abc counter-clockwise.
inline double orient(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return dot(cross(b - a, c - a), d - a);
}

} // namespace surgicalmesher
