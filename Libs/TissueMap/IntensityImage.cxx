// SPDX-License-Identifier: Apache-2.0
#include "IntensityImage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace surgicalmesher
{

namespace
{

constexpr std::size_t kFewestLabels = 32; ///< of an image with values to speak of
constexpr double kUnlikeNeighbours = 0.5; ///< share among all; maps of many small tissues come to a third
constexpr double kSmallSteps = 0.5;       ///< share among the unlike: labels of neighbouring tissues may be any

struct Neighbours
{
  std::size_t pairs = 0, unlike = 0, smallSteps = 0;
};

Neighbours countNeighbours(const TissueMap& map, int smallStep)
{
  Neighbours count;
  const std::array<int, 3>& size = map.grid.size;
  const std::array<std::size_t, 3> stride{ 1, std::size_t(size[0]), std::size_t(size[0]) * size[1] };
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        const std::array<int, 3> voxel{ i, j, k };
        const std::size_t index = map.grid.index(i, j, k);
        for (int axis = 0; axis < 3; ++axis)
        {
          if (map.labels[index] == 0 || voxel[axis] + 1 == size[axis]) continue;
          const Label other = map.labels[index + stride[axis]];
          if (other == 0) continue;
          const int step = std::abs(int(map.labels[index]) - int(other));
          ++count.pairs;
          count.unlike += step > 0;
          count.smallSteps += step > 0 && step <= smallStep;
        }
      }
    }
  }
  return count;
}

} // namespace

std::string likenessToIntensities(const TissueMap& map)
{
  const std::vector<Label> labels = presentLabels(map);
  if (labels.size() < kFewestLabels) return {};
  const int smallStep = std::max(1, (int(labels.back()) - int(labels.front())) / 10);
  const Neighbours count = countNeighbours(map, smallStep);
  const double unlike = count.pairs ? double(count.unlike) / double(count.pairs) : 0;
  if (unlike < kUnlikeNeighbours || double(count.smallSteps) < kSmallSteps * double(count.unlike)) return {};
  return "looks like an image of intensities, such as a T1 scan, instead of a label map: it has " +
         std::to_string(labels.size()) + " values, and " + std::to_string(std::lround(100 * unlike)) +
         " % of neighbouring voxels differ, mostly by little; expected one value for each tissue";
}

} // namespace surgicalmesher
