// SPDX-License-Identifier: Apache-2.0
#include "MapPreparation.h"

#include "DigitalTopology.h"
#include "TissueMapIO.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

using namespace surgicalmesher;

namespace
{

TissueMap makeMap(int sizeI, int sizeJ, int sizeK, std::vector<Label> labels = {})
{
  TissueMap map;
  map.grid.size = { sizeI, sizeJ, sizeK };
  map.labels = std::move(labels);
  map.labels.resize(map.grid.voxelCount(), 0);
  return map;
}

TissueMap noise(std::mt19937& random, int maximumSize)
{
  const auto size = [&] { return 1 + int(random() % maximumSize); };
  TissueMap map = makeMap(size(), size(), size());
  const int labels = 2 + int(random() % 5), lowest = int(random() % 2), filling = int(random() % 4);
  for (Label& label : map.labels) label = Label(int(random() % 4) < filling ? 1 : lowest + random() % labels);
  return map;
}

PreparationOptions islandsUnder(double volume)
{
  PreparationOptions options;
  options.minimumIslandVolume = volume;
  return options;
}

/// Latecki's definition, label by label: no 2x2 square holds just two diagonal voxels of the label or lacks just two,
/// and no 2x2x2 block holds just two opposite corners or lacks just two.
bool blockIsCritical(const TissueMap& map, int i, int j, int k)
{
  for (int reference = 0; reference < 8; ++reference)
  {
    const Label label = labelAt(map, { i + (reference & 1), j + (reference >> 1 & 1), k + (reference >> 2) });
    std::array<bool, 8> inside;
    for (int c = 0; c < 8; ++c) inside[c] = labelAt(map, { i + (c & 1), j + (c >> 1 & 1), k + (c >> 2) }) == label;
    for (int c = 0; c < 8; ++c)
    {
      for (const auto& [u, v] : { std::pair{ 1, 2 }, { 2, 4 }, { 1, 4 } })
      {
        if (inside[c] == inside[c ^ u ^ v] && inside[c ^ u] == inside[c ^ v] && inside[c] != inside[c ^ u]) return true;
      }
      int like = 0;
      for (int d = 0; d < 8; ++d) like += inside[d] == inside[c];
      if (like == 2 && inside[c] == inside[7 - c]) return true;
    }
  }
  return false;
}

std::size_t criticalBlocksByDefinition(const TissueMap& map)
{
  std::size_t count = 0;
  for (int k = -1; k < map.grid.size[2]; ++k)
  {
    for (int j = -1; j < map.grid.size[1]; ++j)
    {
      for (int i = -1; i < map.grid.size[0]; ++i) count += blockIsCritical(map, i, j, k);
    }
  }
  return count;
}

/// Components under the volume, but for the largest of each tissue.
int islandsLeft(const TissueMap& map, double minimumVolume)
{
  const Regions regions = connectedRegions(map);
  std::map<Label, std::size_t> largest;
  for (const Region& region : regions.list) largest[region.label] = std::max(largest[region.label], region.voxels);
  int islands = 0;
  for (const Region& region : regions.list)
  {
    if (region.label == 0 || double(region.voxels) >= minimumVolume) continue;
    if (region.voxels == largest[region.label]) largest[region.label] = map.labels.size() + 1; // that one may stay
    else ++islands;
  }
  return islands;
}

/// The report adds up to the difference of the two maps, tissue by tissue.
void expectReportMatches(const TissueMap& before, const TissueMap& after, const PreparationReport& report)
{
  std::map<Label, std::size_t> left;
  std::size_t differing = 0, islandVoxels = 0, lost = 0, gained = 0;
  for (std::size_t v = 0; v < before.labels.size(); ++v)
  {
    if (before.labels[v] == after.labels[v]) continue;
    ++left[before.labels[v]];
    ++differing;
  }
  for (const auto& [label, changes] : report.changes)
  {
    EXPECT_EQ(changes.islandVoxels + changes.voxelsLost, left[label]) << "label " << label;
    islandVoxels += changes.islandVoxels;
    lost += changes.voxelsLost;
    gained += changes.voxelsGained;
  }
  EXPECT_EQ(lost, report.contactVoxelsChanged);
  EXPECT_EQ(gained, report.contactVoxelsChanged);
  EXPECT_EQ(islandVoxels + report.contactVoxelsChanged, differing);
}

} // namespace

TEST(MapPreparation, CountsCriticalBlocksAsDefined)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial)
  {
    const TissueMap map = noise(random, 8);
    EXPECT_EQ(countCriticalBlocks(map), criticalBlocksByDefinition(map)) << "trial " << trial;
  }
}

TEST(MapPreparation, EdgeContactIsResolvedByOneVoxel)
{
  TissueMap map = makeMap(6, 6, 6);
  for (Label& label : map.labels) label = 2;
  map.labels[map.grid.index(2, 2, 2)] = 1;
  map.labels[map.grid.index(3, 3, 2)] = 1;
  EXPECT_EQ(countCriticalBlocks(map), 2u);
  const PreparationReport report = prepareMap(map, {});
  EXPECT_EQ(countCriticalBlocks(map), 0u);
  EXPECT_EQ(report.criticalBlocksBefore, 2u);
  EXPECT_EQ(report.contactVoxelsChanged, 1u);
  EXPECT_EQ(presentLabels(map), (std::vector<Label>{ 1, 2 }));
}

TEST(MapPreparation, SmallestMapKeepsItsTissues)
{
  TissueMap map = makeMap(2, 2, 1,
                          { 1, 2, //
                            2, 1 });
  prepareMap(map, islandsUnder(10));
  EXPECT_EQ(countCriticalBlocks(map), 0u);
  EXPECT_EQ(presentLabels(map), (std::vector<Label>{ 1, 2 }));
}

TEST(MapPreparation, TunnelOfACornerWideIsResolved)
{
  // Two corners of background in a solid block: the background touches itself at the centre only.
  TissueMap map = makeMap(4, 4, 4);
  for (Label& label : map.labels) label = 1;
  map.labels[map.grid.index(1, 1, 1)] = 0;
  map.labels[map.grid.index(2, 2, 2)] = 0;
  EXPECT_EQ(countCriticalBlocks(map), 1u);
  const PreparationReport report = prepareMap(map, {});
  EXPECT_EQ(countCriticalBlocks(map), 0u);
  EXPECT_LE(report.contactVoxelsChanged, 2u);
}

TEST(MapPreparation, WellComposedMapStaysAsItIs)
{
  TissueMap map = makeMap(9, 9, 9);
  for (int k = 1; k < 8; ++k)
  {
    for (int j = 1; j < 8; ++j)
    {
      for (int i = 1; i < 8; ++i) map.labels[map.grid.index(i, j, k)] = i < 5 ? 1 : (j < 4 ? 2 : 3);
    }
  }
  map.labels[map.grid.index(3, 3, 3)] = 4; // an island, but nobody asked
  const TissueMap before = map;
  const PreparationReport report = prepareMap(map, {});
  EXPECT_EQ(map.labels, before.labels);
  EXPECT_TRUE(report.changes.empty());
}

TEST(MapPreparation, IslandsUnderTheVolumeGoToWhatSurroundsThem)
{
  TissueMap map = makeMap(12, 5, 5);
  map.grid.spacing = { 1, 1, 2 };
  for (Label& label : map.labels) label = 1;
  for (const int i : { 1, 4, 5 }) map.labels[map.grid.index(i, 2, 2)] = 2;  // components of 2 and 4 mm^3
  for (const int i : { 8, 9, 10 }) map.labels[map.grid.index(i, 2, 2)] = 2; // and of 6
  map.labels[map.grid.index(6, 0, 0)] = 0;
  const PreparationReport report = prepareMap(map, islandsUnder(4));
  EXPECT_EQ(labelAt(map, { 1, 2, 2 }), 1);
  EXPECT_EQ(labelAt(map, { 4, 2, 2 }), 2);
  EXPECT_EQ(labelAt(map, { 6, 0, 0 }), 0);
  EXPECT_EQ(report.changes.at(2).islandsRemoved, 1u);
  EXPECT_EQ(report.changes.at(2).islandVoxels, 1u);
  EXPECT_EQ(report.contactVoxelsChanged, 0u);
}

TEST(MapPreparation, IslandWithinIslandIsFilledFromOutside)
{
  // An island of 2 around one of 3 in a sea of 1; both tissues have larger parts at the far end.
  TissueMap map = makeMap(16, 7, 7);
  for (Label& label : map.labels) label = 1;
  for (int k = 0; k < 7; ++k)
  {
    for (int j = 0; j < 7; ++j) map.labels[map.grid.index(14, j, k)] = 2, map.labels[map.grid.index(15, j, k)] = 3;
  }
  const TissueMap withoutIslands = map;
  for (int v = 0; v < 27; ++v) map.labels[map.grid.index(4 + v % 3, 2 + v / 3 % 3, 2 + v / 9)] = v == 13 ? 3 : 2;
  const PreparationReport report = prepareMap(map, islandsUnder(30));
  EXPECT_EQ(map.labels, withoutIslands.labels);
  EXPECT_EQ(report.changes.at(2).islandVoxels, 26u);
  EXPECT_EQ(report.changes.at(3).islandVoxels, 1u);
}

TEST(MapPreparation, LargestComponentOfATissueStays)
{
  TissueMap map = makeMap(9, 3, 3);
  map.labels[map.grid.index(1, 1, 1)] = 5;
  map.labels[map.grid.index(4, 1, 1)] = 5;
  map.labels[map.grid.index(5, 1, 1)] = 5;
  const PreparationReport report = prepareMap(map, islandsUnder(100));
  EXPECT_EQ(std::count(map.labels.begin(), map.labels.end(), 5), 2);
  EXPECT_EQ(report.changes.at(5).islandsRemoved, 1u);
}

TEST(MapPreparation, IslandsAndPocketsGoOrStayAsAsked)
{
  TissueMap map = makeMap(12, 5, 5);
  for (Label& label : map.labels) label = 1;
  for (const int i : { 2, 8, 9 }) map.labels[map.grid.index(i, 2, 2)] = 2;
  map.labels[map.grid.index(5, 2, 2)] = 0;
  const TissueMap before = map;

  PreparationOptions options;
  options.minimumIslandVolume = options.minimumCavityVolume = 10;
  options.islandVolumes = { { 2, 0 } };
  options.cavityVolumes = { { 1, 1 } };
  prepareMap(map, options);
  EXPECT_EQ(map.labels, before.labels);

  options.cavityVolumes = { { 1, 1.5 } };
  const PreparationReport report = prepareMap(map, options);
  EXPECT_EQ(labelAt(map, { 5, 2, 2 }), 1);
  EXPECT_EQ(labelAt(map, { 2, 2, 2 }), 2);
  EXPECT_EQ(report.changes.at(0).islandsRemoved, 1u);
  EXPECT_EQ(report.changes.at(0).islandVoxels, 1u);
}

TEST(MapPreparation, KeepsItsPromisesOnNoise)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 3000; ++trial)
  {
    const TissueMap before = noise(random, 12);
    TissueMap map = before;
    const PreparationOptions options = islandsUnder(trial % 3 * 6.0);
    const PreparationReport report = prepareMap(map, options);
    ASSERT_EQ(countCriticalBlocks(map), 0u) << "trial " << trial;
    EXPECT_EQ(presentLabels(map), presentLabels(before)) << "trial " << trial;
    EXPECT_EQ(islandsLeft(map, options.minimumIslandVolume), 0) << "trial " << trial;
    expectReportMatches(before, map, report);
  }
}

TEST(MapPreparation, MarginIsOfNoInfluence)
{
  std::mt19937 random(6);
  for (int trial = 0; trial < 50; ++trial)
  {
    const TissueMap before = noise(random, 12);
    TissueMap narrow = before, wide = before;
    PreparationReport report;
    copyWithoutMargin(preparedMap(before, 1, islandsUnder(6), report), narrow);
    copyWithoutMargin(preparedMap(before, 5, islandsUnder(6), report), wide);
    ASSERT_EQ(narrow.labels, wide.labels) << "trial " << trial;
  }
}

TEST(MapPreparation, ResolvesDenseNoiseAndCheckerboards)
{
  std::mt19937 random(3);
  TissueMap dense = makeMap(40, 40, 40), board = dense;
  for (Label& label : dense.labels) label = Label(random() % 10);
  for (std::size_t v = 0; v < board.labels.size(); ++v) board.labels[v] = Label(1 + (v + v / 40 + v / 1600) % 2);
  prepareMap(dense, {});
  prepareMap(board, {});
  EXPECT_EQ(countCriticalBlocks(dense), 0u);
  EXPECT_EQ(countCriticalBlocks(board), 0u);
}

TEST(MapPreparation, CancellingLeavesTheMap)
{
  std::mt19937 random(4);
  TissueMap map = noise(random, 12);
  const TissueMap before = map;
  const Progress cancel = [](double fraction, const std::string&)
  {
    if (fraction == 1) throw std::runtime_error("cancelled");
  };
  EXPECT_THROW(prepareMap(map, islandsUnder(5), cancel), std::runtime_error);
  EXPECT_EQ(map.labels, before.labels);
}

TEST(MapPreparation, BrainAtlas)
{
  const std::string file = "/usr/share/mricron/templates/jhu189.nii.gz";
  if (!std::ifstream(file)) GTEST_SKIP() << "Debian's mricron-data is not installed";
  const TissueMap before = readTissueMap(file);
  TissueMap map = before;
  const PreparationReport report = prepareMap(map, islandsUnder(30));
  EXPECT_EQ(countCriticalBlocks(map), 0u);
  EXPECT_EQ(islandsLeft(map, 30), 0);
  EXPECT_EQ(presentLabels(map), presentLabels(before));
  expectReportMatches(before, map, report);
  const auto tissueVoxels = before.labels.size() - std::count(before.labels.begin(), before.labels.end(), Label(0));
  EXPECT_LT(report.contactVoxelsChanged, 0.0015 * tissueVoxels);

  const TissueMap once = map;
  const PreparationReport again = prepareMap(map, islandsUnder(30));
  EXPECT_EQ(map.labels, once.labels) << "a prepared map needs no preparation";
  EXPECT_TRUE(again.changes.empty());
}
