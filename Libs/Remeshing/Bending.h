// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The bending of the interface around a vertex, as a quadric of where the vertex is: at every edge of its faces the
/// quadratic bending energy of the two triangles there (M. Bergou, M. Wardetzky, D. Harmon, D. Zorin, E. Grinspun, "A
/// quadratic bending model for inextensible surfaces", SGP 2006, equation 4). Two triangles belong together if they
/// part the same two labels, or if both bound the background. An edge counts by 1 / (1 + (angle / 40 degrees)^2), so
/// that creases of the map keep their place.

#include "Quadric.h"

namespace surgicalmesher
{

/// Bending at the faces of `sheet`, were v at p. Edges on a block's border whose other triangle is outside count
/// nothing.
Quadric bendingOf(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet);

/// The corner of the triangle that goes on from `face` beyond its edge ab, if it belongs together with it; -1 if there is
/// none.
std::int32_t cornerBeyond(const TetComplex& complex, const SheetFace& face, std::int32_t a, std::int32_t b);

/// Calls visit(a, b, c, d) for every edge ab of the faces of `sheet`, once from each face there: c is that face's third
/// corner, and d the one beyond. Edges without one are left out.
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

/// What a visit of forEachHinge on the sheet at v counts, so that every edge counts once: those at v come from both faces.
inline double hingeShare(std::int32_t v, std::int32_t c) { return v == c ? 1 : 0.5; }

/// The angle, radians, between the normals of the triangles on both sides of `edge`, whose third corners lie at c and d
/// from its begin.
double deflection(const Vec3& edge, const Vec3& c, const Vec3& d);

} // namespace surgicalmesher
