// SPDX-License-Identifier: Apache-2.0
#include "RepeatedMaps.h"

#include <gtest/gtest.h>

#include <random>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

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

constexpr double anyLength = 1e9;

/// `map` on voxels a `times`-th as long, with `before` and `after` more of background along the axes.
TissueMap fineMap(const TissueMap& map, int times, const std::array<int, 3>& before = {},
                  const std::array<int, 3>& after = {})
{
  return withRepeats(map, repeatsOf(map, times, before, after));
}

void expectOwnVoxels(const TissueMap& map, double shortestLength = anyLength)
{
  const VoxelRepeats repeats = findRepeats(map, shortestLength);
  EXPECT_EQ(repeats.times, 1);
  EXPECT_EQ(withRepeats(map, repeats).labels, map.labels);
}

/// `map` with `count` slices less at one end of an axis.
TissueMap cut(const TissueMap& map, int axis, bool atBegin, int count)
{
  TissueMap result = map;
  result.grid.size[axis] -= count;
  result.labels.clear();
  for (std::size_t v = 0; v < map.labels.size(); ++v)
  {
    const int at = map.grid.voxelAt(v)[axis];
    if (atBegin ? at >= count : at < result.grid.size[axis]) result.labels.push_back(map.labels[v]);
  }
  return result;
}

TEST(RepeatedVoxels, AreFoundAndPutBack)
{
  for (const int times : { 2, 3, 4 })
    for (int n = 0; n < times; ++n)
    {
      const TissueMap coarse = randomMap({ 19, 17, 16 }, 0, unsigned(10 * times + n));
      const std::array<int, 3> before{ n, (n + 1) % times, 0 }, after{ 0, times - 1 - n, n };
      const TissueMap fine = fineMap(coarse, times, before, after);
      const VoxelRepeats repeats = findRepeats(fine, anyLength);
      ASSERT_EQ(repeats.times, times);
      EXPECT_EQ(repeats.first, before);
      const TissueMap found = withoutRepeats(fine, repeats);
      EXPECT_EQ(found.grid.size, coarse.grid.size);
      EXPECT_EQ(found.labels, coarse.labels);
      EXPECT_EQ(found.table.at(2).name, "two");
      EXPECT_EQ(withRepeats(found, repeats).labels, fine.labels);
    }
}

TEST(RepeatedVoxels, StayWhereTheyAre)
{
  const TissueMap fine = fineMap(randomMap({ 15, 15, 15 }, 0, 1), 3, { 2, 1, 0 });
  const VoxelRepeats repeats = findRepeats(fine, anyLength);
  ASSERT_EQ(repeats.times, 3);
  const TissueMap coarse = withoutRepeats(fine, repeats);
  for (const auto& [i, j, k] : { std::array<int, 3>{ 0, 0, 0 }, { 14, 3, 7 } })
  {
    const Vec3 middle = fine.grid.gridToWorld(fine.grid.position(2 + 3 * i + 1, 1 + 3 * j + 1, 3 * k + 1));
    EXPECT_LT(norm(coarse.grid.gridToWorld(coarse.grid.position(i, j, k)) - middle), 1e-12);
  }
}

TEST(RepeatedVoxels, AreAsManyAsAllAxesHave)
{
  const TissueMap coarse = randomMap({ 14, 14, 14 }, 0, 5);
  TissueMap fine = coarse; // two, four and six times along the axes
  fine.grid.size = { 28, 56, 84 };
  fine.labels.clear();
  for (std::size_t v = 0; v < fine.grid.voxelCount(); ++v)
  {
    const auto [i, j, k] = fine.grid.voxelAt(v);
    fine.labels.push_back(coarse.labels[coarse.grid.index(i / 2, j / 4, k / 6)]);
  }
  EXPECT_EQ(findRepeats(fine, anyLength).times, 2);
}

TEST(RepeatedVoxels, AreNoneWhereTheirLatticeGivesNoEdgesAsShort)
{
  const TissueMap map = fineMap(randomMap({ 16, 16, 16 }, 0, 6), 2); // 0.5 x 0.7 x 0.9 mm twice
  EXPECT_EQ(findRepeats(map, 0.125).times, 2);
  expectOwnVoxels(map, 0.12);
}

TEST(RepeatedVoxels, AreNoneWhereOneVoxelDiffers)
{
  TissueMap map = fineMap(randomMap({ 16, 16, 16 }, 1, 2), 2);
  ASSERT_EQ(findRepeats(map, anyLength).times, 2);
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
  const TissueMap whole = fineMap(randomMap({ 16, 16, 16 }, 0, 4), 3);
  ASSERT_EQ(findRepeats(whole, anyLength).times, 3);
  for (const int axis : { 0, 1, 2 })
    for (const bool atBegin : { false, true })
    {
      expectOwnVoxels(cut(whole, axis, atBegin, 1));
      expectOwnVoxels(cut(whole, axis, atBegin, 2));
      EXPECT_EQ(findRepeats(cut(whole, axis, atBegin, 3), anyLength).times, 3);
    }
}

TEST(RepeatedVoxels, AreNoneWhereFewPlacesHaveChanges)
{
  for (const int places : { 11, 12 })
  {
    const TissueMap coarse = randomMap({ 20, 20, places + 1 }, 0, 7); // so many between its slices
    EXPECT_EQ(findRepeats(fineMap(coarse, 2), anyLength).times, places < 12 ? 1 : 2);
  }
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
