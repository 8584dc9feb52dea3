// SPDX-License-Identifier: Apache-2.0
#include "FeatureSimplification.h"

#include "DigitalTopology.h"
#include "MapPreparation.h"
#include "RegionRemoval.h"
#include "TissueMapIO.h"
#include "VoxelBall.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <random>

using namespace surgicalmesher;

namespace
{

TissueMap makeMap(int size, const std::function<Label(int, int, int)>& label)
{
  TissueMap map;
  map.grid.size = { size, size, size };
  for (int k = 0; k < size; ++k)
  {
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i) map.labels.push_back(label(i, j, k));
    }
  }
  return map;
}

/// A block of label 1 with a margin of 4 voxels of background, and whatever `detail` makes of it.
TissueMap blockWith(const std::function<Label(int, int, int, Label)>& detail)
{
  return makeMap(32,
                 [&](int i, int j, int k)
                 {
                   const bool inside = std::min({ i, j, k }) >= 4 && std::max({ i, j, k }) < 28;
                   return detail(i, j, k, inside ? 1 : 0);
                 });
}

double distanceFromAxis(int i, int j) { return std::hypot(i - 15.5, j - 15.5); }

FeatureOptions scaleOf(double featureScale)
{
  FeatureOptions options;
  options.featureScale = featureScale;
  return options;
}

std::set<Label> simplify(TissueMap& map, const ScaleField& scale, const FeatureOptions& options,
                         const Progress& progress = {})
{
  PaddedMap work = padded(map, featureMargin(map.grid, scale, options.featureScale));
  std::set<Label> keptWhole = simplifyFeatures(work, scale, options, progress);
  copyWithoutMargin(work, map);
  return keptWhole;
}

std::set<Label> simplify(TissueMap& map, double size) { return simplify(map, uniformScale(2 * size), scaleOf(0.5)); }

/// L from 1 mm within 6 mm of voxel (0, 0, 0) up to 8 mm.
ScaleField gradedScale(const Grid& grid)
{
  ScaleField scale;
  scale.grid = grid;
  for (int k = 0; k < grid.size[2]; ++k)
  {
    for (int j = 0; j < grid.size[1]; ++j)
    {
      for (int i = 0; i < grid.size[0]; ++i)
      {
        const double d = norm({ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z });
        scale.lengths.push_back(float(std::min(8.0, std::max(1.0, d - 5))));
      }
    }
  }
  return scale;
}

TissueMap noise(std::mt19937& random, int size, int labels)
{
  return makeMap(size, [&](int i, int j, int k)
                 { return Label(random() % 3 ? 1 + (i / 6 + j / 6 + k / 6) % labels : random() % (labels + 1)); });
}

std::size_t differences(const TissueMap& a, const TissueMap& b)
{
  std::size_t count = 0;
  for (std::size_t v = 0; v < a.labels.size(); ++v) count += a.labels[v] != b.labels[v];
  return count;
}

} // namespace

TEST(FeatureSimplification, NarrowTunnelClosesAndWideOneStays)
{
  for (const auto& [radius, tunnels] : { std::pair{ 1.0, 0 }, { 5.0, 1 } })
  {
    TissueMap map =
      blockWith([r = radius](int i, int j, int, Label l) { return distanceFromAxis(i, j) < r ? Label(0) : l; });
    ASSERT_EQ(tissueTopology(map).at(1), (Betti{ 1, 1, 0 }));
    simplify(map, 5);
    EXPECT_EQ(tissueTopology(map).at(1), (Betti{ 1, tunnels, 0 })) << "radius " << radius;
  }
}

TEST(FeatureSimplification, ThinHandleBreaksAndThickOneStays)
{
  for (const auto& [radius, tunnels] : { std::pair{ 1.0, 0 }, { 4.0, 1 } })
  {
    // Two slabs that a pillar of radius 6 and a strand hold together.
    TissueMap map = makeMap(40,
                            [r = radius](int i, int j, int k)
                            {
                              if (k < 10 || k >= 30) return Label(1);
                              return Label(std::hypot(i - 10, j - 10) < 6 || std::hypot(i - 29.5, j - 29.5) < r);
                            });
    ASSERT_EQ(tissueTopology(map).at(1), (Betti{ 1, 1, 0 }));
    simplify(map, 5);
    EXPECT_EQ(tissueTopology(map).at(1), (Betti{ 1, tunnels, 0 })) << "radius " << radius;
  }
}

TEST(FeatureSimplification, SmallIslandsAndPocketsGo)
{
  TissueMap map = blockWith(
    [](int i, int j, int k, Label l)
    {
      if (i >= 8 && i < 11 && j >= 8 && j < 11 && k >= 8 && k < 11) return Label(0);    // a pocket of 27 mm^3
      if (i >= 20 && i < 22 && j >= 20 && j < 22 && k >= 20 && k < 22) return Label(2); // an island of 8 mm^3
      return k >= 30 ? Label(2) : l;
    });
  simplify(map, 4);
  EXPECT_EQ(tissueTopology(map).at(1), (Betti{ 1, 0, 0 }));
  EXPECT_EQ(tissueTopology(map).at(2).components, 1);
}

TEST(FeatureSimplification, FlatAndGentlyRoundedBoundariesStay)
{
  const auto ball = [](int i, int j, int k) { return Label(norm({ i - 15.5, j - 15.5, k - 15.5 }) < 9); };
  TissueMap map = makeMap(32, ball);
  const TissueMap before = map;
  simplify(map, 4);
  EXPECT_EQ(map.labels, before.labels);

  TissueMap block = blockWith([](int, int, int, Label l) { return l; });
  const TissueMap sharp = block;
  simplify(block, 4);
  for (int j = 8; j < 24; ++j)
  {
    for (int i = 0; i < 32; ++i)
      EXPECT_EQ(block.labels[block.grid.index(i, j, 16)], sharp.labels[block.grid.index(i, j, 16)]);
  }
}

TEST(FeatureSimplification, MapBelowTheScaleStays)
{
  std::mt19937 random(1);
  TissueMap map = noise(random, 24, 4);
  map.grid.spacing = { 1, 1.5, 2 };
  const TissueMap before = map;
  simplify(map, uniformScale(8), scaleOf(0));
  simplify(map, uniformScale(1.9), scaleOf(0.5));
  EXPECT_EQ(map.labels, before.labels);

  const ScaleField scale = gradedScale(map.grid);
  simplify(map, scale, scaleOf(0.5));
  EXPECT_GT(differences(map, before), 0u);
  const PaddedMap unpadded = padded(map, 0);
  for (std::size_t v = 0; v < map.labels.size(); ++v)
  {
    const bool isBelow = isBelowScale(unpadded, scale, 0.5, v);
    EXPECT_EQ(isBelow, 0.5 * scale.lengths[v] < 1);
    EXPECT_TRUE(!isBelow || map.labels[v] == before.labels[v]);
  }
}

/// The share rule as FeatureSimplification.h has it, with one size everywhere: every voxel is looked at in every round.
void applyShareRuleEverywhere(PaddedMap& map, double size, int rounds)
{
  const auto steps = neighbourSteps(map.grid);
  const VoxelBall ball(map.grid, (size + 1) / 2);
  const auto share = [&](std::size_t v, Label label) { return ball.count(map.labels.data() + v, label); };
  for (int round = 0; round < rounds; ++round)
  {
    std::vector<Label> next = map.labels;
    for (std::size_t v = 0; v < next.size(); ++v)
    {
      if (map.isInMargin(v) || double(share(v, map.labels[v])) >= std::ceil(0.38 * double(ball.size()))) continue;
      for (const int face : sixNeighbours)
      {
        const Label label = map.labels[v + steps[face]];
        const std::size_t best = share(v, next[v]), other = share(v, label);
        if (other > best || (other == best && next[v] != map.labels[v] && label < next[v])) next[v] = label;
      }
    }
    map.labels = next;
  }
}

/// Islands and pockets under size^3.
void removeRegionsUnder(PaddedMap& map, double size)
{
  const Regions regions = connectedRegions(map);
  std::vector<bool> isSmall = largestRegions(regions);
  for (std::size_t r = 0; r < isSmall.size(); ++r)
    isSmall[r] =
      r != 0 && (!isSmall[r] || regions.list[r].label == 0) && double(regions.list[r].voxels) < size * size * size;
  removeRegions(map, regions, isSmall);
}

TEST(FeatureSimplification, LooksAtEveryVoxelThatMayChange)
{
  std::mt19937 random(7);
  for (int trial = 0; trial < 12; ++trial)
  {
    const double size = 2 + trial % 3;
    TissueMap map = noise(random, 26, 3);
    PaddedMap padding = padded(map, 6);
    applyShareRuleEverywhere(padding, 3, 3); // noise in lumps, which change for several rounds
    copyWithoutMargin(padding, map);
    PaddedMap expected = padded(map, featureMargin(map.grid, uniformScale(2 * size), 0.5)), simplified = expected;
    removeRegionsUnder(expected, size);
    applyShareRuleEverywhere(expected, size, int(size));
    removeRegionsUnder(expected, size);
    const std::set<Label> keptWhole = simplifyFeatures(simplified, uniformScale(2 * size), scaleOf(0.5));
    ASSERT_TRUE(keptWhole.empty()) << trial;
    EXPECT_NE(simplified.labels, padded(map, simplified.margin).labels) << trial;
    EXPECT_EQ(simplified.labels, expected.labels) << trial;
  }
}

TEST(FeatureSimplification, ProtectedLabelsNeitherLoseNorGain)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial)
  {
    TissueMap map = noise(random, 20, 5);
    const TissueMap before = map;
    FeatureOptions options = scaleOf(0.5);
    options.protectedLabels = { Label(trial % 6), 3 };
    simplify(map, uniformScale(8), options);
    for (std::size_t v = 0; v < map.labels.size(); ++v)
    {
      for (const Label label : options.protectedLabels) EXPECT_EQ(map.labels[v] == label, before.labels[v] == label);
    }
  }
}

TEST(FeatureSimplification, TissueSmallerThanTheScaleIsKeptWhole)
{
  const auto rod = [](int i, int j, int k, Label l) { return i == 15 && j == 15 && k > 8 && k < 24 ? Label(2) : l; };
  TissueMap map = blockWith(rod);
  const TissueMap before = map;
  EXPECT_EQ(simplify(map, 4), (std::set<Label>{ 2 }));
  EXPECT_EQ(std::count(map.labels.begin(), map.labels.end(), 2),
            std::count(before.labels.begin(), before.labels.end(), 2));
}

TEST(FeatureSimplification, NoTissueLosesMoreThanHalf)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 30; ++trial)
  {
    TissueMap map = noise(random, 18, 2 + trial % 5);
    const TissueMap before = map;
    simplify(map, gradedScale(map.grid), scaleOf(0.25 * (1 + trial % 6)));
    for (const Label label : presentLabels(before))
    {
      const auto voxels = [label](const TissueMap& m) { return std::count(m.labels.begin(), m.labels.end(), label); };
      EXPECT_GE(2 * voxels(map), voxels(before));
    }
  }
}

TEST(FeatureSimplification, WhatIsKeptWholeMightHaveBeenProtected)
{
  std::mt19937 random(8);
  std::size_t kept = 0;
  for (int trial = 0; trial < 60; ++trial)
  {
    TissueMap map = noise(random, 30, 3);
    for (std::size_t v = 0; v < map.labels.size(); ++v) // small and thin tissues, which are lost by turns
    {
      const auto [i, j, k] = map.grid.voxelAt(v);
      if (j / 6 % 2 && k / 7 % 2 && i % 10 < 1 + trial % 3) map.labels[v] = Label(4 + (i / 10 + j / 12 + k / 14) % 9);
    }
    TissueMap with = map;
    FeatureOptions options = scaleOf(0.5);
    const ScaleField scale = uniformScale(3 + 0.2 * (trial % 20));
    const std::set<Label> keptWhole = simplify(map, scale, options);
    kept += keptWhole.size();
    options.protectedLabels = keptWhole;
    EXPECT_TRUE(simplify(with, scale, options).empty()) << trial;
    EXPECT_EQ(map.labels, with.labels) << trial;
  }
  EXPECT_GT(kept, 60u);
}

TEST(FeatureSimplification, SameResultFromAnyNumberOfThreads)
{
  std::mt19937 random(5);
  TissueMap one = noise(random, 32, 5);
  TissueMap two = one;
  vtkSMPTools::Initialize(1);
  simplify(one, 4);
  vtkSMPTools::Initialize(2);
  simplify(two, 4);
  vtkSMPTools::Initialize();
  EXPECT_EQ(one.labels, two.labels);
}

TEST(FeatureSimplification, CancellingLeavesTheMap)
{
  std::mt19937 random(4);
  TissueMap tissues = noise(random, 16, 3);
  tissues.labels[0] = 9; // will be lost, and all begins anew
  const PaddedMap before = padded(tissues, featureMargin({}, uniformScale(8), 0.5));
  PaddedMap map = before;
  const Progress cancel = [](double fraction, const std::string&)
  {
    if (fraction > 0) throw std::runtime_error("cancelled");
  };
  EXPECT_THROW(simplifyFeatures(map, uniformScale(8), scaleOf(0.5), cancel), std::runtime_error);
  EXPECT_EQ(map.labels, before.labels);
}

TEST(FeatureSimplification, BrainAtlasLosesMostOfItsTunnels)
{
  const std::string file = "/usr/share/mricron/templates/jhu189.nii.gz";
  if (!std::ifstream(file)) GTEST_SKIP() << "Debian's mricron-data is not installed";
  const TissueMap original = readTissueMap(file);
  TissueMap exact = original, simple = original;
  PreparationOptions preparation;
  preparation.minimumIslandVolume = 30;
  prepareMap(exact, preparation);
  simplify(simple, uniformScale(8), scaleOf(0.5));
  prepareMap(simple, preparation);
  const auto tunnels = [](const TissueMap& map)
  {
    int count = 0;
    for (const auto& tissue : tissueTopology(map)) count += tissue.second.tunnels;
    return count;
  };
  EXPECT_LT(2 * tunnels(simple), tunnels(exact));
  EXPECT_EQ(countCriticalBlocks(simple), 0u);
  EXPECT_EQ(presentLabels(simple), presentLabels(original));
  EXPECT_LT(differences(simple, original), original.labels.size() / 50);
}
