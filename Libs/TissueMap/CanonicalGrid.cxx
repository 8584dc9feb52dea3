// SPDX-License-Identifier: Apache-2.0
#include "CanonicalGrid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace surgicalmesher
{

namespace
{

/// The map from file axes to canonical axes: canonical axis w runs along (sign 1) or against (-1) file axis source[w].
struct AxisOrder
{
  std::array<int, 3> source;
  std::array<int, 3> sign;
};

/// The right-handed order whose axes are nearest to +L, +P, +S: of the 24, the one of the largest trace. Ties are
/// decided by the directions in space alone, so that permuted and flipped copies of a map get the same result.
AxisOrder canonicalOrder(const std::array<Vec3, 3>& axes)
{
  constexpr double tolerance = 1e-6;
  AxisOrder best{};
  std::vector<double> bestKey;
  std::array<int, 3> source{ 0, 1, 2 };
  do {
    for (int signs = 0; signs < 8; ++signs)
    {
      AxisOrder order{ source, { signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1 } };
      std::array<Vec3, 3> frame;
      for (int w = 0; w < 3; ++w) frame[w] = order.sign[w] * axes[source[w]];
      if (dot(cross(frame[0], frame[1]), frame[2]) < 0) continue;
      std::vector<double> key{ frame[0].x + frame[1].y + frame[2].z };
      for (const Vec3& axis : frame) key.insert(key.end(), { axis.x, axis.y, axis.z });
      const auto difference = std::mismatch(key.begin(), key.end(), bestKey.begin(), bestKey.end(),
                                            [=](double a, double b) { return std::abs(a - b) < tolerance; });
      if (bestKey.empty() || (difference.first != key.end() && *difference.first > *difference.second))
      {
        best = order;
        bestKey = key;
      }
    }
  } while (std::next_permutation(source.begin(), source.end()));
  return best;
}

} // namespace

// Newton's iteration for the polar decomposition.
std::array<Vec3, 3> orthonormalised(std::array<Vec3, 3> a)
{
  for (int iteration = 0; iteration < 10; ++iteration)
  {
    const Vec3 normals[3] = { cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1]) };
    const double determinant = dot(a[0], normals[0]);
    for (int axis = 0; axis < 3; ++axis) a[axis] = 0.5 * (a[axis] + normals[axis] / determinant);
  }
  return a;
}

bool arePerpendicular(const std::array<Vec3, 3>& axes)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vec3& a = axes[axis];
    const Vec3& b = axes[(axis + 1) % 3];
    if (!(std::abs(dot(a, b)) < 1e-3 * norm(a) * norm(b))) return false;
  }
  return true;
}

CanonicalGrid canonicalGrid(const Grid& in)
{
  const std::ptrdiff_t strides[3] = { 1, in.size[0], std::ptrdiff_t(in.size[0]) * in.size[1] };
  const AxisOrder order = canonicalOrder(in.axes);
  CanonicalGrid out;
  out.grid.origin = in.origin;
  for (int w = 0; w < 3; ++w)
  {
    const int source = order.source[w];
    out.grid.size[w] = in.size[source];
    out.grid.spacing[w] = in.spacing[source];
    out.grid.axes[w] = order.sign[w] * in.axes[source] + Vec3{}; // no negative zeros
    out.stride[w] = order.sign[w] * strides[source];
    if (order.sign[w] > 0) continue;
    out.first += (in.size[source] - 1) * strides[source];
    out.grid.origin += ((in.size[source] - 1) * in.spacing[source]) * in.axes[source];
  }
  return out;
}

} // namespace surgicalmesher
