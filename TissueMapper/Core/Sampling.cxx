// SPDX-License-Identifier: Apache-2.0
#include "Sampling.h"

#include "Errors.h"

namespace surgicalmesher
{

namespace
{

/// `count` neighbouring voxels along one axis, clamped to the grid, and their interpolation weights.
template <int count>
struct Stencil
{
  std::array<int, count> voxel;
  std::array<double, count> weight;
};

template <int count>
Stencil<count> stencilAt(double index, int size)
{
  index = std::clamp(index, 0.0, double(size - 1));
  const int base = std::min(int(index), std::max(size - 2, 0));
  const double t = index - base;
  Stencil<count> stencil;
  if constexpr (count == 2) stencil.weight = { 1 - t, t };
  else
  {
    const double t2 = t * t;
    const double t3 = t2 * t;
    stencil.weight = { 0.5 * (-t3 + 2 * t2 - t), 0.5 * (3 * t3 - 5 * t2 + 2), 0.5 * (-3 * t3 + 4 * t2 + t),
                       0.5 * (t3 - t2) };
  }
  for (int n = 0; n < count; ++n) stencil.voxel[n] = std::clamp(base + n - (count / 2 - 1), 0, size - 1);
  return stencil;
}

template <int count>
double interpolated(const Grid& grid, const std::vector<float>& values, const Vec3& p)
{
  const Vec3 index = toIndex(grid, p);
  std::array<Stencil<count>, 3> axis;
  for (int a = 0; a < 3; ++a) axis[a] = stencilAt<count>(index[a], grid.size[a]);
  double sum = 0;
  for (int k = 0; k < count; ++k)
  {
    for (int j = 0; j < count; ++j)
    {
      const float* row = values.data() + grid.index(0, axis[1].voxel[j], axis[2].voxel[k]);
      double rowSum = 0;
      for (int i = 0; i < count; ++i) rowSum += axis[0].weight[i] * row[axis[0].voxel[i]];
      sum += axis[1].weight[j] * axis[2].weight[k] * rowSum;
    }
  }
  return sum;
}

} // namespace

void requireVoxels(const Grid& grid, int least, const std::string& purpose)
{
  const auto& size = grid.size;
  if (*std::min_element(size.begin(), size.end()) >= least) return;
  throw InputError(std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]) +
                   " voxels, expected " + std::to_string(least) + " or more along each axis " + purpose);
}

double linearValue(const Grid& grid, const std::vector<float>& values, const Vec3& p)
{
  return interpolated<2>(grid, values, p);
}

double cubicValue(const Grid& grid, const std::vector<float>& values, const Vec3& p)
{
  return interpolated<4>(grid, values, p);
}

} // namespace surgicalmesher
