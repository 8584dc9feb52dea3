// SPDX-License-Identifier: Apache-2.0
#include "RepeatedVoxels.h"

#include <gtest/gtest.h>

#include <random>

using namespace surgicalmesher;

namespace
{

Grid obliqueGrid(const std::array<int, 3>& size)
{
  Grid grid;
  grid.size = size;
  grid.spacing = { 0.5, 0.7, 0.9 };
  grid.origin = { 3, -5, 7 };
  grid.axes = { Vec3{ 0.6, 0.8, 0 }, Vec3{ -0.8, 0.6, 0 }, Vec3{ 0, 0, 1 } };
  return grid;
}

/// Labels at random, background in `border` voxels on all sides.
TissueMap randomMap(const std::array<int, 3>& size, int border, unsigned seed)
{
  std::mt19937 random(seed);
  TissueMap map;
  map.grid = obliqueGrid(size);
  map.table[2].name = "two";
  for (std::size_t v = 0; v < map.grid.voxelCount(); ++v)
  {
    const auto at = map.grid.voxelAt(v);
    bool isInside = true;
    for (int a = 0; a < 3; ++a) isInside = isInside && at[a] >= border && at[a] < size[a] - border;
    map.labels.push_back(isInside ? Label(random() % 3) : Label(0));
  }
  return map;
}

/// `map` on voxels a `times`-th as long, with `before` and `after` more of background along each axis.
TissueMap fineMap(const TissueMap& map, int times, int before, int after)
{
  Grid grid = map.grid;
  for (int a = 0; a < 3; ++a) grid.size[a] = map.grid.size[a] * times + before + after;
  return withRepeats(map, { times, { before, before, before } }, grid);
}

void expectOwnVoxels(const TissueMap& map) { EXPECT_EQ(findRepeats(map).times, 1); }

TEST(RepeatedVoxels, AreFoundAndPutBack)
{
  for (const int times : { 2, 3, 4 })
    for (int before = 0; before < times; ++before)
    {
      const TissueMap coarse = randomMap({ 19, 17, 16 }, 0, unsigned(10 * times + before));
      const int after = times - 1 - before;
      const TissueMap fine = fineMap(coarse, times, before, after);
      const VoxelRepeats repeats = findRepeats(fine);
      ASSERT_EQ(repeats.times, times);
      EXPECT_EQ(repeats.first, (std::array<int, 3>{ before, before, before }));
      const TissueMap found = withoutRepeats(fine, repeats);
      EXPECT_EQ(found.grid.size, coarse.grid.size);
      EXPECT_EQ(found.labels, coarse.labels);
      EXPECT_EQ(found.table.at(2).name, "two");
      EXPECT_EQ(withRepeats(found, repeats, fine.grid).labels, fine.labels);
    }
}

TEST(RepeatedVoxels, StayWhereTheyAre)
{
  const TissueMap fine = fineMap(randomMap({ 15, 15, 15 }, 0, 1), 3, 2, 0);
  const VoxelRepeats repeats = findRepeats(fine);
  ASSERT_EQ(repeats.times, 3);
  const TissueMap coarse = withoutRepeats(fine, repeats);
  for (const auto& [i, j, k] : { std::array<int, 3>{ 0, 0, 0 }, { 14, 3, 7 } })
  {
    const Vec3 middle = fine.grid.gridToWorld(fine.grid.position(2 + 3 * i + 1, 2 + 3 * j + 1, 2 + 3 * k + 1));
    EXPECT_LT(norm(coarse.grid.gridToWorld(coarse.grid.position(i, j, k)) - middle), 1e-12);
  }
}

TEST(RepeatedVoxels, AreNoneWhereOneVoxelDiffers)
{
  TissueMap map = fineMap(randomMap({ 16, 16, 16 }, 1, 2), 2, 0, 0);
  ASSERT_EQ(findRepeats(map).times, 2);
  map.labels[map.grid.index(17, 9, 12)] ^= 4;
  expectOwnVoxels(map);
}

TEST(RepeatedVoxels, AreNoneAlongTwoAxesOnly)
{
  const TissueMap map = randomMap({ 32, 32, 16 }, 0, 3);
  TissueMap slices = map; // thick ones, cut
  slices.grid.size[2] *= 2;
  slices.labels.clear();
  const std::size_t slice = 32 * 32;
  for (int k = 0; k < 32; ++k)
    slices.labels.insert(slices.labels.end(), map.labels.begin() + std::ptrdiff_t(k / 2 * slice),
                         map.labels.begin() + std::ptrdiff_t((k / 2 + 1) * slice));
  expectOwnVoxels(slices);
}

TEST(RepeatedVoxels, AreNoneWhereTheBorderCutsTissue)
{
  const TissueMap whole = fineMap(randomMap({ 16, 16, 16 }, 0, 4), 2, 0, 0);
  TissueMap cut = whole;
  cut.grid.size[0] = 31;
  cut.labels.clear();
  for (std::size_t v = 0; v < whole.labels.size(); ++v)
    if (v % 32 != 31) cut.labels.push_back(whole.labels[v]);
  expectOwnVoxels(cut);
}

TEST(RepeatedVoxels, AreNoneInABoxWhoseWallsAreEven)
{
  TissueMap map;
  map.grid.size = { 64, 64, 64 };
  map.labels.assign(map.grid.voxelCount(), 0);
  for (int k = 16; k < 48; ++k)
    for (int j = 16; j < 48; ++j)
      for (int i = 16; i < 48; ++i) map.labels[map.grid.index(i, j, k)] = 1;
  expectOwnVoxels(map);
}

TEST(RepeatedVoxels, AreNoneInAnEmptyMap)
{
  TissueMap map;
  expectOwnVoxels(map);
  map.grid.size = { 4, 4, 4 };
  map.labels.assign(64, 7);
  expectOwnVoxels(map);
}

} // namespace
