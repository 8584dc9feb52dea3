// SPDX-License-Identifier: Apache-2.0
#include "ScaleField.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Rounds to a millionth, never to -0.
Vec3 rounded(const Vec3& v)
{
  const auto round = [](double x) { return std::round(x * 1e6) / 1e6 + 0.0; };
  return { round(v.x), round(v.y), round(v.z) };
}

/// Rounds to a millionth; spacings below 0.01 mm to five significant digits.
Vec3 roundedSpacing(const Vec3& spacing)
{
  const auto round = [](double x)
  {
    const double unit = x >= 0.01 ? 1e6 : std::pow(10, 4 - std::floor(std::log10(x)));
    return std::round(x * unit) / unit;
  };
  return { round(spacing.x), round(spacing.y), round(spacing.z) };
}

} // namespace

double ScaleField::operator()(const Vec3& world) const
{
  const Vec3 p = grid.worldToGrid(world);
  const std::size_t strides[3] = { 1, std::size_t(grid.size[0]), std::size_t(grid.size[0]) * grid.size[1] };
  std::size_t base = 0;
  std::size_t step[3];
  double weight[3]; // of the upper neighbour
  for (int axis = 0; axis < 3; ++axis)
  {
    const int last = grid.size[axis] - 1;
    const double index = std::min(double(last), std::max(0.0, p[axis] / grid.spacing[axis]));
    const int lower = std::max(0, std::min(int(index), last - 1));
    base += lower * strides[axis];
    step[axis] = lower < last ? strides[axis] : 0;
    weight[axis] = index - lower;
  }
  const float* corner = lengths.data() + base;
  const auto mix = [](double a, double b, double w) { return a + w * (b - a); };
  const auto alongI = [&](std::size_t offset) { return mix(corner[offset], corner[offset + step[0]], weight[0]); };
  const auto alongJ = [&](std::size_t offset) { return mix(alongI(offset), alongI(offset + step[1]), weight[1]); };
  return mix(alongJ(0), alongJ(step[2]), weight[2]);
}

Grid inOwnFrame(const Grid& grid)
{
  Grid own;
  own.size = grid.size;
  own.spacing = roundedSpacing(grid.spacing);
  return own;
}

ScaleField inFrameOf(const Grid& frame, const ScaleField& scale)
{
  ScaleField moved = scale;
  moved.grid.spacing = roundedSpacing(scale.grid.spacing);
  moved.grid.origin = inFrameOf(frame, scale.grid.origin);
  for (Vec3& axis : moved.grid.axes)
  {
    axis = rounded({ dot(axis, frame.axes[0]), dot(axis, frame.axes[1]), dot(axis, frame.axes[2]) });
  }
  return moved;
}

Vec3 inFrameOf(const Grid& frame, const Vec3& world) { return rounded(frame.worldToGrid(world)); }

ScaleField uniformScale(double edgeLength)
{
  ScaleField scale;
  scale.grid.size = { 1, 1, 1 };
  scale.lengths = { float(edgeLength) };
  return scale;
}

} // namespace surgicalmesher
