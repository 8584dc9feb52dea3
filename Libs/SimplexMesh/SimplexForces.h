// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Forces on the vertices of a simplex mesh. A force is given as the displacement, in mm, to the position that its term
/// alone would give the vertex.

#include "SimplexMesh.h"
#include "TissueBoundary.h"

namespace surgicalmesher
{

/// Continuity constraint: the reference simplex angle of each vertex (Delingette 1999).
enum class Continuity
{
  /// The vertex keeps its angle: it only slides to its reference metric parameters, and the surface bends freely.
  C0,
  C1, ///< 0: a plane
  C2  ///< the angle that yields the mean curvature of the neighbourhood
};

struct InternalForceOptions
{
  Continuity continuity = Continuity::C2;
  int rigidity = 2; ///< radius of the C2 neighbourhood, in edges
  /// Reference metric parameters, for the neighbours on side 0 in their order.
  std::array<double, 3> metric{ 1. / 3, 1. / 3, 1. / 3 };
};

/// Returns the sum of the tangential and the normal force on each vertex: the position with the reference metric
/// parameters and the reference angle, minus the vertex. Where a vertex is on the surfaces of two tissues, the force is
/// the mean of those on each surface; it is zero where the vertex has neighbours on neither.
std::vector<Vec3> internalForces(const SimplexMesh& mesh, const InternalForceOptions& options = {});

/// Returns, at each dual point, the resistance to bending along the normal, over a width (mm, by point) of many edges.
/// Let S be the mean over a neighbourhood of that width, independent of its edge lengths, and h = normal . (x - S x), a
/// measure of the mean curvature at that width. C1 gives the displacement that makes h vanish, C2 the one that gives h
/// the mean of the neighbourhood's, and C0 none. `dual` must consist of closed surfaces of two labels each.
std::vector<Vec3> bendingForces(const SurfaceComplex& dual, Continuity continuity, const std::vector<double>& widths);

/// Returns, at each dual point, the mean of the values of the vertices (dual triangles) around it.
std::vector<Vec3> meansAround(const SurfaceComplex& dual, const std::vector<Vec3>& perVertex);

/// Returns area-weighted unit normals at the points, pointing out of the tissue behind; zero at points without
/// triangles.
std::vector<Vec3> pointNormals(const SurfaceComplex& surface);

/// Returns the mean curvature sin(phi) / r at each vertex, 1/mm, on the surface of the tissue on each side: positive
/// where that tissue is convex, 0 without neighbours.
std::vector<std::array<double, 2>> meanCurvatures(const SimplexMesh& mesh);

/// Returns the force on each triangle of `dual` along its normal, towards the boundary between its two tissues. The
/// displacement is the mean over three quadrature points of second order: on a curved boundary the triangle then lies
/// on both sides of it, and the volume is preserved. Points with no boundary within reach exert no force. `distances`,
/// if given, receives the largest distance over these points for each triangle (the reach, if no boundary is nearer).
std::vector<Vec3> imageForces(const SurfaceComplex& dual, const TissueBoundary& boundary,
                              std::vector<double>* distances = nullptr);

} // namespace surgicalmesher
