// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Comparison of two surfaces of the same tissues: their distance, and the quality of their triangles.

#include "MeshQuality.h"

namespace surgicalmesher
{

struct SurfaceDistance
{
  double mean = 0, maximum = 0; ///< mm
  Vec3 where;                   ///< position of the maximum
};

/// Returns the distances from `from` to the nearest points of `to` between the same labels, sampled at the corners,
/// edge midpoints and centroids of the triangles, all with equal weight.
SurfaceDistance surfaceDistance(const SurfaceComplex& from, const SurfaceComplex& to);

struct TriangleQuality
{
  Distribution smallestAngle; ///< degrees, of each triangle
  Distribution edgeLength;    ///< mm, three per triangle
  double edgeVariation = 0;   ///< coefficient of variation of the edge lengths
};

TriangleQuality triangleQuality(const SurfaceComplex& surface);

} // namespace surgicalmesher
