// SPDX-License-Identifier: Apache-2.0
#include "SimplexGeometry.h"

#include <algorithm>

namespace surgicalmesher
{

CircumCircle circumCircle(const SimplexNeighbours& neighbours)
{
  const Vec3 a = neighbours[1] - neighbours[0], b = neighbours[2] - neighbours[0], n = cross(a, b);
  const double area2 = squaredNorm(n), lengths2 = squaredNorm(a) * squaredNorm(b);
  CircumCircle circle;
  if (!(area2 > 1e-20 * lengths2))
  {
    circle.centre = (neighbours[0] + neighbours[1] + neighbours[2]) / 3;
    for (const Vec3& p : neighbours) circle.radius = std::max(circle.radius, norm(p - circle.centre));
    return circle;
  }
  const Vec3 toCentre = cross(squaredNorm(a) * b - squaredNorm(b) * a, n) / (2 * area2);
  circle.centre = neighbours[0] + toCentre;
  circle.radius = norm(toCentre);
  circle.normal = n / std::sqrt(area2);
  return circle;
}

double SimplexShape::meanCurvature() const { return circle.radius > 0 ? std::sin(angle) / circle.radius : 0; }

SimplexShape simplexShape(const Vec3& p, const SimplexNeighbours& neighbours)
{
  SimplexShape shape;
  shape.circle = circumCircle(neighbours);
  const Vec3& n = shape.circle.normal;
  shape.metric = { 1. / 3, 1. / 3, 1. / 3 };
  if (squaredNorm(n) == 0) return shape;
  shape.height = dot(p - neighbours[0], n);
  const Vec3 foot = p - shape.height * n;
  const double area = dot(cross(neighbours[1] - neighbours[0], neighbours[2] - neighbours[0]), n);
  for (int k = 0; k < 3; ++k)
    shape.metric[k] = dot(cross(neighbours[(k + 1) % 3] - foot, neighbours[(k + 2) % 3] - foot), n) / area;
  shape.offset = norm(foot - shape.circle.centre);
  shape.angle = simplexAngle(shape.circle.radius, shape.offset, shape.height);
  return shape;
}

// The sphere's centre lies o = (h^2 + d^2 - r^2) / 2h above C; sin(phi) = s r / R and cos(phi) = -s o / R with the sign
// s of h, so that R and the division by h cancel.
double simplexAngle(double radius, double offset, double height)
{
  return std::atan2(2 * height * radius, radius * radius - offset * offset - height * height);
}

// Delingette's L(r, d, phi) without its tangent, which is undefined at 90 degrees. Beyond 90 degrees, the second form
// avoids cancellation.
double simplexHeight(double radius, double offset, double angle)
{
  const double r2 = radius * radius, d2 = offset * offset, s = std::sin(angle), c = std::cos(angle);
  if (d2 >= r2 || s == 0) return 0;
  const double root = std::sqrt(r2 - d2 * s * s);
  return c >= 0 ? (r2 - d2) * s / (root + radius * c) : (root - radius * c) / s;
}

Vec3 simplexPosition(const SimplexNeighbours& neighbours, const std::array<double, 3>& metric, double angle)
{
  const CircumCircle circle = circumCircle(neighbours);
  const Vec3 foot = metric[0] * neighbours[0] + metric[1] * neighbours[1] + metric[2] * neighbours[2];
  return foot + simplexHeight(circle.radius, norm(foot - circle.centre), angle) * circle.normal;
}

double angleOfCurvature(double curvature, double radius, bool beyond)
{
  const double angle = std::asin(std::clamp(curvature * radius, -1., 1.));
  return beyond ? std::copysign(std::acos(-1.), angle) - angle : angle;
}

} // namespace surgicalmesher
