// SPDX-License-Identifier: Apache-2.0
#include "TissueMap.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace surgicalmesher;

namespace
{

/// Every voxel has a label of its own.
TissueMap numberedMap(const std::array<int, 3>& size)
{
  TissueMap map;
  map.grid.size = size;
  map.grid.spacing = { 0.5, 0.7, 0.9 };
  map.grid.origin = { 3, -5, 7 };
  map.grid.axes = { Vec3{ 0.6, 0.8, 0 }, Vec3{ -0.8, 0.6, 0 }, Vec3{ 0, 0, 1 } };
  for (std::size_t v = 0; v < map.grid.voxelCount(); ++v) map.labels.push_back(Label(v + 1));
  map.table[2].name = "two";
  return map;
}

/// The label that the map has in the middle of a voxel of another one.
Label labelAtPlaceOf(const TissueMap& map, const TissueMap& other, int i, int j, int k)
{
  const Vec3 p = map.grid.worldToGrid(other.grid.gridToWorld(other.grid.position(i, j, k)));
  std::array<int, 3> voxel;
  for (int a = 0; a < 3; ++a)
  {
    voxel[a] = int(std::lround(p[a] / map.grid.spacing[a]));
    EXPECT_NEAR(p[a], voxel[a] * map.grid.spacing[a], 1e-9);
  }
  return labelAt(map, voxel);
}

void expectLabelsOf(const TissueMap& map, const TissueMap& thin)
{
  ASSERT_EQ(thin.labels.size(), thin.grid.voxelCount());
  for (int k = 0; k < thin.grid.size[2]; ++k)
    for (int j = 0; j < thin.grid.size[1]; ++j)
      for (int i = 0; i < thin.grid.size[0]; ++i)
        EXPECT_EQ(labelAt(thin, { i, j, k }), labelAtPlaceOf(map, thin, i, j, k)) << i << " " << j << " " << k;
}

} // namespace

TEST(EveryNth, KeepsVoxelsWhereTheyAre)
{
  const TissueMap map = numberedMap({ 7, 6, 5 });
  for (int n = 1; n < 9; ++n)
  {
    const TissueMap thin = everyNth(map, n);
    for (int a = 0; a < 3; ++a) EXPECT_EQ(thin.grid.size[a], (map.grid.size[a] - 1) / n + 1);
    EXPECT_EQ(thin.labels.front(), map.labels.front());
    EXPECT_EQ(thin.table.at(2).name, "two");
    expectLabelsOf(map, thin);
  }
}

TEST(EveryNth, BeginsAndEndsWhereItIsTold)
{
  const TissueMap map = numberedMap({ 7, 6, 5 });
  const TissueMap thin = everyNth(map, 2, { 1, 0, 2 }, { 3, 2, 1 });
  EXPECT_EQ(thin.grid.size, (std::array<int, 3>{ 3, 2, 1 }));
  EXPECT_EQ(thin.labels.front(), labelAt(map, { 1, 0, 2 }));
  EXPECT_EQ(thin.labels.back(), labelAt(map, { 5, 2, 2 }));
  expectLabelsOf(map, thin);
}

TEST(FreeLabels, FollowAllThatAreTaken)
{
  TissueMap map = numberedMap({ 3, 1, 1 });
  EXPECT_EQ(freeLabels(map, 2), (std::vector<Label>{ 4, 5 }));
  map.table[8].name = "named, without a voxel";
  EXPECT_EQ(freeLabels(map, 1), (std::vector<Label>{ 9 }));
  EXPECT_EQ(freeLabels(map, 1, { 20 }), (std::vector<Label>{ 21 }));
  map.labels[0] = 65534;
  EXPECT_EQ(freeLabels(map, 1), (std::vector<Label>{ 65535 }));
  EXPECT_EQ(freeLabels(map, 4), (std::vector<Label>{ 1, 4, 5, 6 })); // 2, 3, 8 and 65534 are taken
}

TEST(FreeLabels, AreFewerWhereFewerAreFree)
{
  TissueMap map = numberedMap({ 65535, 1, 1 });
  EXPECT_TRUE(freeLabels(map, 1).empty());
  map.labels[6] = 0;
  EXPECT_EQ(freeLabels(map, 2), std::vector<Label>{ 7 });
}
