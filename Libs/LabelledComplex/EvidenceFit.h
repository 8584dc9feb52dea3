#pragma once
/// Where the evidence of the interface faces at a vertex would like the vertex to be.

#include "TetComplex.h"

namespace surgicalmesher
{

/// An interface face at a vertex v.
struct SheetFace
{
  std::int32_t tet;
  int face;
  std::int32_t x, y; ///< its two vertices beside v
};

/// The interface faces at v, each once. `star`: the tetrahedra at v.
void sheetFaces(const TetComplex& complex, std::int32_t v, const std::vector<std::int32_t>& star,
                std::vector<SheetFace>& faces);

/// Normal equations m x = g, m symmetric.
struct Fit
{
  double m[6] = { 0, 0, 0, 0, 0, 0 }; ///< xx xy xz yy yz zz
  Vec3 g;

  double trace() const { return m[0] + m[3] + m[5]; }
  void addToDiagonal(double value) { m[0] += value, m[3] += value, m[5] += value; }
  Vec3 times(const Vec3& x) const;
  Vec3 solve(const Vec3& right) const; ///< zero if m is singular
};

/// Least squares for the step of v that brings `faces` nearest to their evidence: m step = g, mm. With `robust` (mm) > 0,
/// evidence at distance d weighs 1 / (1 + d / robust), one round of iteratively reweighted least squares for the mean
/// distance, and so for the volume between surface and map, instead of its square.
Fit fitOf(const TetComplex& complex, std::int32_t v, const std::vector<SheetFace>& faces, double robust = 0);

} // namespace surgicalmesher
