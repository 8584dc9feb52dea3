// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether two triangles of a surface cross: the test that keeps it free of self-intersections. It errs on the safe
/// side: what comes within rounding of a crossing counts as one.

#include "Vec3.h"

#include <array>
#include <cstdint>

namespace surgicalmesher
{

struct CornerTriangle
{
  std::array<Vec3, 3> corners;
  std::array<std::int32_t, 3> ids; ///< equal ids are the same point
};

/// Triangles with no common corner cross where they have a point in common; with one, where they have another one; with
/// two, where they are folded onto each other to less than 8 degrees; with three, always.
bool trianglesCross(const CornerTriangle& a, const CornerTriangle& b);

} // namespace surgicalmesher
