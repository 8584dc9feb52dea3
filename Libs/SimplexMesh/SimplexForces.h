// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Forces on the vertices of a simplex mesh. A force is the displacement, in mm, to where its term alone would put the
/// vertex.

#include "SimplexMesh.h"
#include "TissueBoundary.h"

namespace surgicalmesher
{

/// What the reference angle asks of the surface (Delingette 1999).
enum class Continuity
{
  C0, ///< nothing: the angle that the vertex has; it only slides to its metric parameters, and the surface bends freely
  C1, ///< a plane: 0
  C2  ///< the mean curvature of the neighbourhood
};

struct InternalForceOptions
{
  Continuity continuity = Continuity::C2;
  int rigidity = 2;                                       ///< edges that the neighbourhood of C2 reaches
  std::array<double, 3> metric{ 1. / 3, 1. / 3, 1. / 3 }; ///< reference metric parameters, of the
                                                          ///< neighbours on side 0 in their order
};

/// The tangential and the normal force as one: the position that has the reference metric parameters and the reference
/// angle, less the vertex. Where a vertex is on the surfaces of two tissues, the mean of what it is on each; none where
/// it has neighbours on neither.
std::vector<Vec3> internalForces(const SimplexMesh& mesh, const InternalForceOptions& options = {});

/// What resists bending over a width (mm, by point) of many edges, at each dual point and along its normal. With S the
/// mean over a neighbourhood of that width, the same whatever the length of its edges, and h = normal . (x - S x), the
/// mean curvature at that width: C1 is the way that makes h vanish, C2 the one that gives it the mean of the
/// neighbourhood's, and C0 is none. `dual` is closed surfaces of two labels each.
std::vector<Vec3> bendingForces(const SurfaceComplex& dual, Continuity continuity, const std::vector<double>& widths);

/// At each dual point, the mean of what its vertices have.
std::vector<Vec3> meansAround(const SurfaceComplex& dual, const std::vector<Vec3>& perVertex);

/// Unit normals at the points, out of the tissue behind, weighted by area; zero where there are no triangles.
std::vector<Vec3> pointNormals(const SurfaceComplex& surface);

/// Mean curvature sin(phi) / r at each vertex, 1/mm, on the surface of the tissue on each side: positive where that
/// tissue is convex. 0 without neighbours.
std::vector<std::array<double, 2>> meanCurvatures(const SimplexMesh& mesh);

/// Towards the boundary between the two tissues of each triangle of the dual, along the triangle's normal. The way is
/// the mean over three points that integrate a triangle to second order: on a curved boundary the triangle then lies on
/// both sides, and the volume stays. Nothing within reach, no force. `distances`, if given, receives for each triangle
/// its largest distance over these points (the reach, if there is nothing nearer).
std::vector<Vec3> imageForces(const SurfaceComplex& dual, const TissueBoundary& boundary,
                              std::vector<double>* distances = nullptr);

} // namespace surgicalmesher
