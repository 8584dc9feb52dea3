// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The quadric of a vertex: the sum of squared distances of its faces to their boundary samples, as a function of the
/// vertex's position. Its minimum is the least-squares position (after Garland and Heckbert, SIGGRAPH 1997, with
/// samples of the boundary in place of planes).

#include "BoundarySamples.h"

namespace surgicalmesher
{

/// Normal equations m x = g, m symmetric.
struct Quadric
{
  double m[6] = { 0, 0, 0, 0, 0, 0 }; ///< xx xy xz yy yz zz
  Vec3 g;

  double trace() const { return m[0] + m[3] + m[5]; }
  void addToDiagonal(double value) { m[0] += value, m[3] += value, m[5] += value; }
  void add(const Quadric& other, double weight);
  Vec3 times(const Vec3& x) const;
  Vec3 solve(const Vec3& right) const; ///< zero if m is singular
};

/// Returns the normal equations m step = g for the step (mm) of v that brings the faces of its `sheet` nearest to their
/// samples. With `robust` (mm) > 0, a sample at distance d has weight 1 / (1 + d / robust): one round of iteratively
/// reweighted least squares for the mean distance, and so for the volume between surface and map, instead of the mean
/// square. A sample with a normal also draws v itself onto its plane, if v lies within the radius in which the boundary
/// is nearly plane. With `rigidity` > 0, the bending of the interface at v (Bending.h) is added, with a trace
/// `rigidity` times that of the samples.
Quadric quadricOf(const TetComplex& complex, std::int32_t v, const Sheet& sheet, double robust = 0,
                  double rigidity = 0);

/// Returns m of quadricOf() without robust weights and rigidity: how the samples resist a step of v. g is zero.
Quadric resistanceOf(const TetComplex& complex, std::int32_t v, const Sheet& sheet);

/// Returns quadricOf() for v at position p.
Quadric quadricWith(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet, double robust,
                    double rigidity = 0);

} // namespace surgicalmesher
