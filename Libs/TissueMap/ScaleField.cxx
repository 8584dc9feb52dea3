#include "ScaleField.h"

#include <algorithm>

namespace surgicalmesher
{

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

ScaleField uniformScale(double edgeLength)
{
  ScaleField scale;
  scale.grid.size = { 1, 1, 1 };
  scale.lengths = { float(edgeLength) };
  return scale;
}

} // namespace surgicalmesher
