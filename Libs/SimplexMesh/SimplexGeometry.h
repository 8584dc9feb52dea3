// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Geometry of one vertex of a 2-simplex mesh and its three neighbours (H. Delingette, "General object reconstruction
/// based on simplex meshes", Int. J. Computer Vision 32, 1999).
///
/// A vertex P has the neighbours P1, P2, P3, counter-clockwise as seen from outside. (C, r) is the circumcircle of the
/// neighbours, N their unit normal, F the projection of P onto their plane, d = |F - C|. The *simplex angle* phi in
/// (-pi, pi] is defined by the sphere through all four points: it is positive where the surface is convex and 0 where
/// it is flat; on a sphere of radius R, sin(phi) = r / R up to sign. The metric parameters (barycentric coordinates of
/// F), phi and the three neighbours determine P.

#include "Vec3.h"

#include <array>

namespace surgicalmesher
{

using SimplexNeighbours = std::array<Vec3, 3>;

struct CircumCircle
{
  Vec3 centre;
  double radius = 0;
  /// Unit normal; zero if the three points are collinear: the centre is then their mean, the radius the largest
  /// distance from it.
  Vec3 normal;
};

CircumCircle circumCircle(const SimplexNeighbours& neighbours);

struct SimplexShape
{
  CircumCircle circle;
  std::array<double, 3> metric{}; ///< metric parameters; their sum is 1
  double offset = 0;              ///< d, mm
  double height = 0;              ///< of P over the plane of its neighbours, mm
  double angle = 0;               ///< phi

  /// Returns the mean curvature, that of the sphere through the four points: sin(phi) / r, 1/mm.
  double meanCurvature() const;
};

/// For collinear neighbours, the metric parameters are 1/3 and height and angle are 0.
SimplexShape simplexShape(const Vec3& p, const SimplexNeighbours& neighbours);

/// Returns phi from the height of a vertex. atan2 keeps the branch beyond 90 degrees, which an arcsine would fold.
double simplexAngle(double radius, double offset, double height);

/// Inverse of simplexAngle: returns the height over the plane of the neighbours, mm. Where offset >= radius, two
/// heights have the same angle, and 0 is returned.
double simplexHeight(double radius, double offset, double angle);

/// Returns the position of the vertex with these metric parameters and this simplex angle relative to its neighbours.
Vec3 simplexPosition(const SimplexNeighbours& neighbours, const std::array<double, 3>& metric, double angle);

/// Returns the simplex angle at which a vertex over a circle of this radius has this mean curvature; `beyond` selects
/// the branch over 90 degrees. |curvature| is clamped to 1 / radius, since no circle is larger than its sphere.
double angleOfCurvature(double curvature, double radius, bool beyond);

} // namespace surgicalmesher
