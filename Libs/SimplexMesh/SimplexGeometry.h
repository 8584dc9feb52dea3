// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Geometry of one vertex of a 2-simplex mesh and its three neighbours (H. Delingette, "General object reconstruction
/// based on simplex meshes", Int. J. Computer Vision 32, 1999).
///
/// Vertex P with neighbours P1, P2, P3, named counter-clockwise as seen from outside. (C, r) is the circumcircle of the
/// neighbours, N their unit normal, F the foot of P on their plane, d = |F - C|. The *simplex angle* phi in (-pi, pi]
/// is the angle that the sphere through all four turns by: positive where the surface is convex, 0 where it is flat,
/// sin(phi) = r / R up to sign on a sphere of radius R. Metric parameters (barycentric coordinates of F), phi and the
/// three neighbours determine P.

#include "Vec3.h"

#include <array>

namespace surgicalmesher
{

using SimplexNeighbours = std::array<Vec3, 3>;

struct CircumCircle
{
  Vec3 centre;
  double radius = 0;
  Vec3 normal; ///< unit; zero if the three points lie on a line: centre and radius are then those of their mean
};

CircumCircle circumCircle(const SimplexNeighbours& neighbours);

struct SimplexShape
{
  CircumCircle circle;
  std::array<double, 3> metric{}; ///< metric parameters; their sum is 1
  double offset = 0;              ///< d, mm
  double height = 0;              ///< of P over the plane of its neighbours, mm
  double angle = 0;               ///< phi

  /// Of the sphere through the four points: sin(phi) / r, 1/mm.
  double meanCurvature() const;
};

/// Neighbours on a line give metric parameters of 1/3 and no height.
SimplexShape simplexShape(const Vec3& p, const SimplexNeighbours& neighbours);

/// phi of a vertex of this height: atan2 keeps the branch beyond 90 degrees, which an arcsine would fold.
double simplexAngle(double radius, double offset, double height);

/// The inverse of simplexAngle: the height over the plane of the neighbours, mm. Where offset >= radius two heights
/// have the same angle, and the answer is the plane, 0.
double simplexHeight(double radius, double offset, double angle);

/// The vertex that has these metric parameters and this simplex angle over these neighbours.
Vec3 simplexPosition(const SimplexNeighbours& neighbours, const std::array<double, 3>& metric, double angle);

/// The simplex angle at which a vertex over a circle of this radius has this mean curvature; `beyond` takes the branch
/// over 90 degrees. No circle is larger than the sphere: |curvature| counts as 1 / radius at most.
double angleOfCurvature(double curvature, double radius, bool beyond);

} // namespace surgicalmesher
