// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Test whether two triangles of a surface intersect, which keeps surfaces free of self-intersections. The test is
/// conservative: triangles within rounding error of an intersection count as intersecting.

#include "Vec3.h"

#include <array>
#include <cstdint>

namespace surgicalmesher
{

struct CornerTriangle
{
  std::array<Vec3, 3> corners;
  std::array<std::int32_t, 3> ids; ///< equal ids denote the same point
};

/// Returns whether the triangles cross. Without a common corner, they cross if they have a point in common; with one,
/// if they have another point in common; with two, if they are folded onto each other with an angle below 8 degrees;
/// with three, always.
bool trianglesCross(const CornerTriangle& a, const CornerTriangle& b);

} // namespace surgicalmesher
