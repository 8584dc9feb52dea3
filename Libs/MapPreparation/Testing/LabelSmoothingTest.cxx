// SPDX-License-Identifier: Apache-2.0
#include "LabelSmoothing.h"

#include "DigitalTopology.h"
#include "LocalTopology.h"
#include "MapPreparation.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

const LabelSmoothingOptions usual{};

SmoothedLabels smoothed(const TissueMap& map, double length = 4, const LabelSmoothingOptions& options = usual)
{
  return smoothLabels(map, uniformScale(length), options);
}

int isWithin(int from, int to, int i, int j, int k)
{
  return std::min({ i, j, k }) >= from && std::max({ i, j, k }) < to;
}

/// A block with a crack of one voxel, open at one end.
TissueMap cracked()
{
  return paintedMap({ 24, 24, 24 },
                    [](int i, int j, int k) { return isWithin(4, 20, i, j, k) && !(i == 12 && j >= 10) ? 1 : 0; });
}

std::size_t different(const TissueMap& a, const TissueMap& b)
{
  std::size_t count = 0;
  for (std::size_t v = 0; v < a.labels.size(); ++v) count += a.labels[v] != b.labels[v];
  return count;
}

/// How much lower columns of tissue are beside seams than elsewhere, voxels, in stripes six voxels wide.
double grooveAlongSeams(const TissueMap& map)
{
  double height[2] = {}, columns[2] = {};
  for (int j = 8; j < 40; ++j)
    for (int i = 8; i < 40; ++i)
    {
      const bool isBesideSeam = i % 6 == 0 || i % 6 == 5;
      ++columns[isBesideSeam];
      for (int k = 0; k < map.grid.size[2]; ++k) height[isBesideSeam] += labelAt(map, { i, j, k }) != 0;
    }
  return height[0] / columns[0] - height[1] / columns[1];
}

} // namespace

TEST(LabelSmoothing, ACrackOfOneVoxelCloses)
{
  const TissueMap result = smoothed(cracked()).map;
  EXPECT_EQ(labelAt(result, { 12, 12, 12 }), 1);
  EXPECT_EQ(tissueTopology(result), tissueTopology(cracked()));
}

TEST(LabelSmoothing, ACrackStaysWhereElementsAreAsFineAsVoxels)
{
  EXPECT_EQ(labelAt(smoothed(cracked(), 1).map, { 12, 12, 12 }), 0);
}

TEST(LabelSmoothing, WallsAndEdgesOfABoxStay)
{
  const TissueMap box =
    paintedMap({ 24, 24, 24 }, [](int i, int j, int k) { return isWithin(4, 20, i, j, k) ? 1 : 0; });
  EXPECT_LE(different(smoothed(box).map, box), 16u) << "its corners, and what balances their volume";
}

/// A strand one voxel high and so many wide and long, within another tissue.
TissueMap withStrand(int wide, int length)
{
  return paintedMap({ 40, 40, 40 },
                    [=](int i, int j, int k)
                    {
                      if (!isWithin(3, 37, i, j, k)) return 0;
                      const bool isStrand = i >= 18 && i < 18 + wide && j == 18;
                      return isStrand && k >= 5 && k < 5 + length ? 2 : 1;
                    });
}

TEST(LabelSmoothing, StrandsAndSpecksStayHoweverThin)
{
  for (const double length : { 1.2, 2.0, 4.0 })
    for (const int wide : { 1, 2 })
      for (const int voxels : { 2, 8, 30 })
      {
        const TissueMap map = withStrand(wide, voxels);
        const TissueMap result = smoothed(map, length).map;
        EXPECT_GE(countVoxels(result).at(2), 0.9 * wide * voxels) << length << ' ' << wide << ' ' << voxels;
        EXPECT_EQ(tissueTopology(result), tissueTopology(map));
      }
}

TEST(LabelSmoothing, ProtectedTissuesKeepEveryVoxel)
{
  LabelSmoothingOptions options;
  options.protectedLabels = { 1 };
  EXPECT_EQ(different(smoothed(cracked(), 4, options).map, cracked()), 0u);
}

TEST(LabelSmoothing, NoiseGoesAndEveryTissueKeepsItsTopologyAndVolume)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    std::mt19937 random(seed);
    TissueMap map = paintedMap({ 26, 26, 26 },
                               [&](int i, int j, int k)
                               {
                                 if (!isWithin(2, 24, i, j, k)) return 0;
                                 const int label = 1 + (i / 9 + j / 9 + k / 9) % 3;
                                 return random() % 8 ? label : int(random() % 4);
                               });
    prepareMap(map, { .minimumIslandVolume = 8, .islandVolumes = {}, .cavityVolumes = {} });
    const SmoothedLabels result = smoothed(map);
    EXPECT_GT(different(result.map, map), 100u);
    EXPECT_EQ(tissueTopology(result.map), tissueTopology(map)) << seed;
    EXPECT_EQ(countCriticalBlocks(result.map), 0u) << seed;
    const auto before = countVoxels(map), after = countVoxels(result.map);
    for (const auto& [label, voxels] : before)
    {
      if (label != 0)
      {
        EXPECT_NEAR(double(after.at(label)), double(voxels), 0.03 * double(voxels)) << seed;
      }
    }
  }
}

TEST(LabelSmoothing, ASmallTissueKeepsItsVolumeAmongLargeOnes)
{
  std::map<Label, double> before, after; // single maps are off by up to a tenth, as no voxel is half
  for (unsigned seed = 0; seed < 12; ++seed)
  {
    std::mt19937 random(seed);
    const auto paint = [&](int i, int j, int k)
    {
      if (!isWithin(2, 46, i, j, k)) return 0;
      const bool isSmall = std::abs(i - 24) < 6 && std::abs(j - 24) < 6 && k == 24;
      return isSmall ? 3 : k + int(random() % 3) < 25 ? 1 : 2;
    };
    TissueMap map = paintedMap({ 48, 48, 48 }, paint);
    prepareMap(map, { .minimumIslandVolume = 8, .islandVolumes = {}, .cavityVolumes = {} });
    for (const auto& [label, voxels] : countVoxels(map)) before[label] += double(voxels);
    for (const auto& [label, voxels] : countVoxels(smoothed(map).map)) after[label] += double(voxels);
  }
  for (const Label label : { 1, 2 }) EXPECT_NEAR(after[label], before[label], 0.001 * before[label]) << label;
  EXPECT_NEAR(after[3], before[3], 0.075 * before[3]);
}

TEST(LabelSmoothing, DigsHardlyAGrooveAlongSeams)
{
  constexpr unsigned maps = 6;
  double groove = 0;
  for (unsigned seed = 0; seed < maps; ++seed)
  {
    std::mt19937 random(seed);
    std::vector<int> height(48 * 48);
    for (int& h : height) h = 12 + int(random() % 4);
    TissueMap map = paintedMap({ 48, 48, 24 },
                               [&](int i, int j, int k)
                               {
                                 const bool isTissue = std::min(i, j) >= 2 && std::max(i, j) < 46 && k >= 2;
                                 return isTissue && k < height[48 * j + i] ? 1 + (i / 6) % 3 : 0;
                               });
    prepareMap(map, { .minimumIslandVolume = 8, .islandVolumes = {}, .cavityVolumes = {} });
    groove += (grooveAlongSeams(smoothed(map).map) - grooveAlongSeams(map)) / maps;
  }
  EXPECT_LT(groove, 0.15);
}

TEST(LabelSmoothing, ListsWhatChanged)
{
  const SmoothedLabels result = smoothed(cracked());
  std::size_t lost = 0;
  for (const MapChange& change : result.changes) lost += change.kind < ChangeKind::Cavity ? change.voxels : 0;
  EXPECT_EQ(lost, different(result.map, cracked()));
}

TEST(LocalTopology, AVoxelBetweenTwoPartsIsNotSimple)
{
  Neighbourhood around{};
  around[4] = around[13] = around[22] = 1; // a strand along k
  EXPECT_FALSE(isSimple(around, 0));
  around[22] = 0; // its end
  EXPECT_TRUE(isSimple(around, 0));
  EXPECT_TRUE(keepsTopology(around, 0));
}

TEST(LocalTopology, TheLastVoxelAndACavityAreNotSimple)
{
  Neighbourhood around{};
  around[13] = 1;
  EXPECT_FALSE(isSimple(around, 0));
  around.fill(1);
  EXPECT_FALSE(isSimple(around, 0));
}

TEST(LocalTopology, AContactIsSeen)
{
  Neighbourhood around{};
  around[12] = around[13] = 1;
  around[16] = 1; // touches 12 along an edge once the centre is gone
  EXPECT_FALSE(keepsTopology(around, 0));
}
