// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Corners, box and quality of single triangles, shared by the parts of SimplexOperators.

#include "BoxGrid.h"
#include "TriangleCrossing.h"

#include <cmath>

namespace surgicalmesher
{

inline bool contains(const std::array<std::int32_t, 3>& corners, std::int32_t p)
{
  return corners[0] == p || corners[1] == p || corners[2] == p;
}

inline std::int32_t thirdCorner(const std::array<std::int32_t, 3>& corners, std::int32_t a, std::int32_t b)
{
  for (std::int32_t c : corners)
    if (c != a && c != b) return c;
  return -1;
}

inline Box boxOf(const CornerTriangle& t)
{
  Box box = Box::around(t.corners[0]);
  box.add(t.corners[1]);
  box.add(t.corners[2]);
  return box;
}

/// Returns 4 sqrt(3) area / sum of squared edges: 1 for an equilateral triangle, 0 for a degenerate one.
inline double qualityOf(const CornerTriangle& t)
{
  const auto& [a, b, c] = t.corners;
  const double edges = squaredNorm(b - a) + squaredNorm(c - b) + squaredNorm(a - c);
  return edges > 0 ? 2 * std::sqrt(3.) * norm(cross(b - a, c - a)) / edges : 0;
}

} // namespace surgicalmesher
