// SPDX-License-Identifier: Apache-2.0
#include "VoxelBall.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <vector>

namespace surgicalmesher
{

TEST(VoxelBall, CountsTheVoxelsWhoseCentresAreWithinTheRadius)
{
  Grid grid;
  grid.size = { 23, 21, 13 };
  grid.spacing = { 0.5, 0.7, 1.1 };
  const std::array<int, 3> middle{ 11, 10, 6 };
  std::mt19937 random(1);
  std::vector<Label> labels(std::size_t(23) * 21 * 13);
  for (Label& label : labels) label = Label(random() % 3 == 0 ? 65535 : random() % 3);
  for (const double radius : { 0., 0.4, 0.5, 1.1, 2.3, 4.25, 5. })
  {
    SCOPED_TRACE(radius);
    const VoxelBall ball(grid, radius);
    std::map<Label, std::size_t> expected;
    std::size_t voxels = 0;
    for (int k = 0; k < grid.size[2]; ++k)
      for (int j = 0; j < grid.size[1]; ++j)
        for (int i = 0; i < grid.size[0]; ++i)
        {
          const Vec3 way{ (i - middle[0]) * 0.5, (j - middle[1]) * 0.7, (k - middle[2]) * 1.1 };
          if (squaredNorm(way) > radius * radius) continue;
          ++expected[labels[grid.index(i, j, k)]];
          ++voxels;
        }
    EXPECT_EQ(ball.size(), voxels);
    const Label* const at = labels.data() + grid.index(middle[0], middle[1], middle[2]);
    for (const Label label : { 0, 1, 2, 3, 65535 }) EXPECT_EQ(ball.count(at, label), expected[label]) << label;
  }
}

} // namespace surgicalmesher
