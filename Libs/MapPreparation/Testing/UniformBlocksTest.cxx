// SPDX-License-Identifier: Apache-2.0
#include "UniformBlocks.h"

#include "DigitalTopology.h"
#include "RandomMaps.h"
#include "ScaleMaps.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <cmath>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

TissueMap ball(double radius)
{
  const int size = 2 * int(std::ceil(radius)) + 6;
  const double middle = 0.5 * (size - 1);
  return paintedMap({ size, size, size },
                    [&](int i, int j, int k) {
                      return squaredNorm(Vec3{ i - middle, j - middle, k - middle }) < radius * radius;
                    });
}

/// Share of the blocks of `side` voxels that hold one label.
double uniformShare(const TissueMap& map, int side)
{
  const auto& size = map.grid.size;
  int uniform = 0, all = 0;
  for (int k = 0; k + side <= size[2]; k += side)
    for (int j = 0; j + side <= size[1]; j += side)
      for (int i = 0; i + side <= size[0]; i += side, ++all)
      {
        bool isUniform = true;
        for (int n = 0; n < side * side * side; ++n)
          isUniform &=
            labelAt(map, { i + n % side, j + n / side % side, k + n / side / side }) == labelAt(map, { i, j, k });
        uniform += isUniform;
      }
  return double(uniform) / all;
}

TEST(UniformBlocks, keepTheTopologyOfEveryLabelOnRandomMaps)
{
  std::mt19937 random(7);
  for (int n = 0; n < 60; ++n)
  {
    const TissueMap map = randomWellComposedMap(random, { 12, 11, 13 }, 4);
    const TissueMap blocks = withUniformBlocks(map, uniformScale(20));
    EXPECT_EQ(tissueTopology(blocks), tissueTopology(map)) << n;
    EXPECT_TRUE(wellComposed(blocks)) << n;
  }
}

TEST(UniformBlocks, areOneLabelNearlyEverywhereOnABall)
{
  const TissueMap map = ball(13);
  EXPECT_LT(uniformShare(map, 2), 0.93);
  EXPECT_GT(uniformShare(withUniformBlocks(map, uniformScale(4)), 2), 0.99);
  EXPECT_GT(uniformShare(withUniformBlocks(map, uniformScale(8)), 4), 0.97);
}

TEST(UniformBlocks, moveBoundariesByLessThanABlock)
{
  const double radius = 13;
  const TissueMap map = ball(radius), blocks = withUniformBlocks(map, uniformScale(8));
  const double middle = 0.5 * (map.grid.size[0] - 1);
  for (std::size_t v = 0; v < map.labels.size(); ++v)
  {
    if (map.labels[v] == blocks.labels[v]) continue;
    const auto [i, j, k] = map.grid.voxelAt(v);
    EXPECT_LT(std::abs(norm(Vec3{ i - middle, j - middle, k - middle }) - radius), 4 * std::sqrt(3.0));
  }
}

TEST(UniformBlocks, leaveMapsAloneWhereElementsAreSmall)
{
  const TissueMap map = ball(9);
  EXPECT_EQ(withUniformBlocks(map, uniformScale(3.9)).labels, map.labels);
  const Vec3 corner;
  const TissueMap graded = withUniformBlocks(map, radialScale(map.grid, corner, 1, 8, 12, 1));
  for (std::size_t v = 0; v < map.labels.size(); ++v)
  {
    const auto [i, j, k] = map.grid.voxelAt(v);
    if (norm(Vec3{ double(i), double(j), double(k) }) < 8)
    {
      EXPECT_EQ(graded.labels[v], map.labels[v]);
    }
  }
  EXPECT_NE(graded.labels, map.labels);
}

/// One voxel wide, along the first axis.
TissueMap rod(int first, int last)
{
  return paintedMap({ 40, 8, 8 }, [&](int i, int j, int k) { return i >= first && i < last && j == 3 && k == 3; });
}

TEST(UniformBlocks, leaveTheEndsOfThinTissues)
{
  const TissueMap two = rod(4, 8); // two blocks: one could go whole, from its tip
  EXPECT_EQ(withUniformBlocks(two, uniformScale(4)).labels, two.labels);

  for (int first = 4; first < 12; ++first)
  {
    const int last = first + 24;
    const TissueMap blocks = withUniformBlocks(rod(first, last), uniformScale(100));
    const auto isLeft = [&](int i) { return labelAt(blocks, { i, 3, 3 }) == 1; };
    int begin = first, end = last;
    while (begin < last && !isLeft(begin)) ++begin;
    while (end > begin && !isLeft(end - 1)) --end;
    EXPECT_LE(begin, first + 7) << first; // half of each of its blocks
    EXPECT_GE(end, last - 7) << first;
  }
}

TEST(UniformBlocks, leaveProtectedLabelsAlone)
{
  const TissueMap map = ball(9);
  EXPECT_EQ(withUniformBlocks(map, uniformScale(8), { 0.5, { 1 } }).labels, map.labels);
}

TEST(UniformBlocks, leaveFlatVoxelsAlone)
{
  TissueMap map = ball(9);
  map.grid.spacing.z = 3;
  EXPECT_EQ(withUniformBlocks(map, uniformScale(20)).labels, map.labels);
}

TEST(UniformBlocks, areTheSameOnAnyNumberOfThreads)
{
  std::mt19937 random(3);
  const TissueMap map = randomWellComposedMap(random, { 20, 20, 20 }, 5, 300);
  vtkSMPTools::Initialize(1);
  const TissueMap alone = withUniformBlocks(map, uniformScale(10));
  vtkSMPTools::Initialize(4);
  EXPECT_EQ(withUniformBlocks(map, uniformScale(10)).labels, alone.labels);
  vtkSMPTools::Initialize();
  EXPECT_NE(alone.labels, map.labels);
}

} // namespace
