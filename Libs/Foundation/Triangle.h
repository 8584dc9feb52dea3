// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Distance to a triangle.

#include "Vec3.h"

namespace surgicalmesher
{

/// Squared distance from p to triangle abc, by Voronoi regions (C. Ericson, Real-Time Collision Detection, 2005,
/// 5.1.5). The triangle must not be degenerate.
double squaredDistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace surgicalmesher
