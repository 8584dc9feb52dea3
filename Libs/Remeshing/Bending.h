// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The bending of the interface around a vertex, as a quadric in the position of the vertex: the sum, over the edges of
/// the interface faces at the vertex, of the quadratic bending energy of the two triangles at the edge (M. Bergou, M.
/// Wardetzky, D. Harmon, D. Zorin, E. Grinspun, "A quadratic bending model for inextensible surfaces", SGP 2006,
/// equation 4). Two triangles at an edge form a hinge if they separate the same two labels, or if both bound the
/// background. An edge weighs 1 / (1 + (angle / 40 degrees)^2), so that creases of the map keep their place.

#include "Quadric.h"

namespace surgicalmesher
{

/// Returns the quadric of the bending at the faces of `sheet` (the interface faces at v) for a step (mm) of v from p.
/// Edges on a block's border whose other triangle lies outside the block do not count.
Quadric bendingOf(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet);

/// Returns the third corner of the triangle that continues the interface from `face` across its edge ab; -1 if no
/// triangle there forms a hinge with `face`.
std::int32_t cornerBeyond(const TetComplex& complex, const SheetFace& face, std::int32_t a, std::int32_t b);

/// Calls visit(a, b, c, d) for every edge ab of every face of `sheet`: c is the third corner of that face, and d is
/// cornerBeyond(). Edges without such a corner are skipped; an edge that two faces of `sheet` share is visited twice.
template <class Visit>
void forEachHinge(const TetComplex& complex, const Sheet& sheet, const Visit& visit)
{
  for (const SheetFace& f : sheet.faces)
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = f.vertices[k], b = f.vertices[(k + 1) % 3], c = f.vertices[(k + 2) % 3];
      if (const std::int32_t d = cornerBeyond(complex, f, a, b); d >= 0) visit(a, b, c, d);
    }
}

/// The weight of a visit of forEachHinge on the sheet at v with which every edge counts once: edges at v are visited
/// from both of their faces.
inline double hingeShare(std::int32_t v, std::int32_t c) { return v == c ? 1 : 0.5; }

/// Returns the angle, radians, between the normals of the two triangles at `edge`. c and d are the vectors from the
/// start of the edge to their third corners.
double deflection(const Vec3& edge, const Vec3& c, const Vec3& d);

} // namespace surgicalmesher
