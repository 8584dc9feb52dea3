// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two surfaces of the same tissues: how far they lie apart, and how good their triangles are.

#include "MeshQuality.h"

namespace surgicalmesher
{

struct SurfaceDistance
{
  double mean = 0, maximum = 0; ///< mm
  Vec3 where;                   ///< of the largest
};

/// From the corners, the middles of edges and the centroids of `from`, weighted alike, to the nearest point of `to`
/// between the same labels.
SurfaceDistance surfaceDistance(const SurfaceComplex& from, const SurfaceComplex& to);

struct TriangleQuality
{
  Distribution smallestAngle; ///< degrees, of each triangle
  Distribution edgeLength;    ///< mm, each triangle's three
  double edgeVariation = 0;   ///< standard deviation of the edge lengths over their mean
};

TriangleQuality triangleQuality(const SurfaceComplex& surface);

} // namespace surgicalmesher
