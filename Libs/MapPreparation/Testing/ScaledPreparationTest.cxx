// SPDX-License-Identifier: Apache-2.0
#include "ScaledPreparation.h"

#include "DigitalTopology.h"
#include "ScaleMaps.h"
#include "TissueMapIO.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// Slabs of 1 at both ends in k, and between them what `detail` says.
TissueMap slabs(const std::function<int(int, int, int)>& detail)
{
  return paintedMap({ 24, 24, 24 },
                    [&](int i, int j, int k)
                    {
                      const bool isWithin = std::min({ i, j, k }) >= 2 && std::max({ i, j, k }) < 22;
                      if (!isWithin) return 0;
                      return k < 8 || k >= 16 ? 1 : detail(i, j, k);
                    });
}

int isStrand(int i, int j, int at) { return i >= at && i < at + 2 && j >= at && j < at + 2; }

/// The one piece of this kind.
MapChange theOnly(ChangeKind kind, Label label, const std::vector<MapChange>& changes)
{
  MapChange found;
  int count = 0;
  for (const MapChange& change : changes)
  {
    if (change.kind != kind || change.label != label) continue;
    found = change;
    ++count;
  }
  EXPECT_EQ(count, 1) << nameOf(kind) << " of " << label;
  return found;
}

std::size_t voxelsOf(const std::vector<MapChange>& changes, bool lost)
{
  std::size_t sum = 0;
  for (const MapChange& change : changes) sum += (change.kind < ChangeKind::Cavity) == lost ? change.voxels : 0;
  return sum;
}

TissueMap noise(std::mt19937& random, int size, int labels)
{
  return paintedMap({ size, size, size }, [&](int i, int j, int k)
                    { return random() % 3 ? 1 + (i / 6 + j / 6 + k / 6) % labels : int(random() % (labels + 1)); });
}

FeatureOptions featuresOf(double featureScale)
{
  FeatureOptions options;
  options.featureScale = featureScale;
  return options;
}

std::vector<MapChange> changesBetween(const TissueMap& before, const TissueMap& after)
{
  return mapChanges(padded(before, 1), padded(after, 1));
}

std::size_t differences(const TissueMap& a, const TissueMap& b)
{
  std::size_t count = 0;
  for (std::size_t v = 0; v < a.labels.size(); ++v) count += a.labels[v] != b.labels[v];
  return count;
}

/// Every voxel twice along i.
TissueMap stretched(const TissueMap& map)
{
  const auto& n = map.grid.size;
  return paintedMap({ 2 * n[0], n[1], n[2] }, [&](int i, int j, int k) { return int(labelAt(map, { i / 2, j, k })); });
}

} // namespace

TEST(MapChanges, StrandIsANeckWhereItAloneJoins)
{
  const TissueMap before = slabs([](int i, int j, int) { return isStrand(i, j, 5); });
  const TissueMap after = slabs([](int, int, int) { return 0; });
  const std::vector<MapChange> changes = changesBetween(before, after);
  EXPECT_EQ(changes.size(), 2u);
  const MapChange neck = theOnly(ChangeKind::Neck, 1, changes);
  EXPECT_EQ(neck.voxels, 32u);
  EXPECT_LE(norm(neck.place - Vec3{ 5.5, 5.5, 11.5 }), 1.5);
  EXPECT_EQ(theOnly(ChangeKind::Tunnel, 0, changes).voxels, 32u);
}

TEST(MapChanges, StrandIsAHandleBesideAnother)
{
  const TissueMap before = slabs([](int i, int j, int) { return isStrand(i, j, 5) || isStrand(i, j, 15); });
  const TissueMap after = slabs([](int i, int j, int) { return isStrand(i, j, 15); });
  EXPECT_EQ(theOnly(ChangeKind::Handle, 1, changesBetween(before, after)).voxels, 32u);
}

TEST(MapChanges, PassagePocketAndPit)
{
  const TissueMap after = slabs([](int, int, int) { return 1; });
  const TissueMap passage = slabs([](int i, int, int k) { return !(k == 12 && (i == 9 || i == 10)); });
  const TissueMap pocket = slabs([](int i, int j, int k) { return !(i == 9 && j == 9 && k == 9); });
  const TissueMap pit = slabs([](int i, int j, int k) { return !(i < 5 && j == 9 && k == 9); });
  EXPECT_EQ(theOnly(ChangeKind::Tunnel, 1, changesBetween(passage, after)).voxels, 40u);
  const std::vector<MapChange> filled = changesBetween(pocket, after);
  EXPECT_EQ(theOnly(ChangeKind::Cavity, 1, filled).voxels, 1u);
  EXPECT_EQ(theOnly(ChangeKind::Island, 0, filled).voxels, 1u);
  EXPECT_EQ(theOnly(ChangeKind::Cleft, 1, changesBetween(pit, after)).voxels, 3u);
}

TEST(MapChanges, IslandAndTipByTissue)
{
  const TissueMap before =
    slabs([](int i, int j, int k) { return k == 12 && j == 12 && i < 6 ? 3 : isStrand(i, j, 9) && k < 11; });
  const TissueMap after = slabs([](int, int, int) { return 0; });
  const std::vector<MapChange> changes = changesBetween(before, after);
  EXPECT_EQ(theOnly(ChangeKind::Island, 3, changes).voxels, 4u);
  EXPECT_EQ(theOnly(ChangeKind::End, 1, changes).voxels, 12u);
  EXPECT_TRUE(changesBetween(before, before).empty());
}

TEST(MapChanges, APieceIsOfTheSameKindWithTwiceTheVoxels)
{
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial)
  {
    const TissueMap before = noise(random, 7, 2);
    TissueMap after = before;
    for (Label& label : after.labels)
      if (random() % 20 == 0) label = Label(random() % 3);
    const std::vector<MapChange> changes = changesBetween(before, after);
    const std::vector<MapChange> same = changesBetween(stretched(before), stretched(after));
    ASSERT_EQ(changes.size(), same.size()) << trial;
    for (std::size_t n = 0; n < same.size(); ++n)
    {
      EXPECT_EQ(changes[n].label, same[n].label);
      EXPECT_EQ(changes[n].kind, same[n].kind) << trial << ": " << changes[n].voxels;
      EXPECT_EQ(2 * changes[n].voxels, same[n].voxels);
    }
  }
}

TEST(ScaledPreparation, WithoutFeatureScaleIsPreparation)
{
  std::mt19937 random(1);
  TissueMap one = noise(random, 16, 4);
  TissueMap two = one;
  PreparationOptions options;
  options.minimumIslandVolume = 5;
  prepareMap(one, options);
  const ScaledPreparationReport report = prepareAtScale(two, uniformScale(8), options, featuresOf(0));
  EXPECT_EQ(one.labels, two.labels);
  EXPECT_TRUE(report.simplification.empty());
}

TEST(ScaledPreparation, KeepsItsPromisesOnNoise)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 60; ++trial)
  {
    const TissueMap given = noise(random, 18, 2 + trial % 5);
    const ScaleField scale = radialScale(given.grid, { 4, 5, 6 }, 1, 8, 4, 6);
    PreparationOptions preparation;
    preparation.minimumIslandVolume = trial % 3 * 6.0;
    FeatureOptions features = featuresOf(0.25 * (1 + trial % 6));
    features.protectedLabels = { Label(trial % 4) };
    TissueMap prepared = given, simple = given;
    prepareMap(prepared, preparation);
    const ScaledPreparationReport report = prepareAtScale(simple, scale, preparation, features);

    ASSERT_EQ(countCriticalBlocks(simple), 0u) << "trial " << trial;
    EXPECT_EQ(presentLabels(simple), presentLabels(given)) << "trial " << trial;
    const PaddedMap unpadded = padded(given, 0);
    for (std::size_t v = 0; v < given.labels.size(); ++v)
    {
      const bool isBelow = isBelowScale(unpadded, scale, features.featureScale, v);
      ASSERT_TRUE(!isBelow || simple.labels[v] == prepared.labels[v]) << "trial " << trial;
      for (const Label label : features.protectedLabels)
        ASSERT_EQ(simple.labels[v] == label, prepared.labels[v] == label) << "trial " << trial;
    }
    EXPECT_EQ(voxelsOf(report.simplification, true), differences(prepared, simple));
    EXPECT_EQ(voxelsOf(report.simplification, false), differences(prepared, simple));
  }
}

TEST(ScaledPreparation, CancellingLeavesTheMap)
{
  std::mt19937 random(3);
  TissueMap map = noise(random, 16, 3);
  const TissueMap before = map;
  const Progress cancel = [](double fraction, const std::string&)
  {
    if (fraction == 1) throw std::runtime_error("cancelled");
  };
  EXPECT_THROW(prepareAtScale(map, uniformScale(8), {}, featuresOf(0.5), cancel), std::runtime_error);
  EXPECT_EQ(map.labels, before.labels);
}

TEST(ScaledPreparation, BrainAtlasIsTheSameNearTheTarget)
{
  const std::string file = "/usr/share/mricron/templates/jhu189.nii.gz";
  if (!std::ifstream(file)) GTEST_SKIP() << "Debian's mricron-data is not installed";
  const TissueMap given = readTissueMap(file);
  const Vec3 target{ 0, 0, -10 };
  const ScaleField scale = radialScale(given.grid, target, 1, 8, 15, 25); // 16 samples along an axis
  PreparationOptions preparation;
  preparation.minimumIslandVolume = 30;
  TissueMap prepared = given, simple = given;
  prepareMap(prepared, preparation);
  const ScaledPreparationReport report = prepareAtScale(simple, scale, preparation, featuresOf(0.5));
  EXPECT_EQ(countCriticalBlocks(simple), 0u);
  EXPECT_EQ(voxelsOf(report.simplification, true), differences(prepared, simple));
  const Grid& grid = given.grid;
  for (int k = 0; k < grid.size[2]; ++k)
  {
    for (int j = 0; j < grid.size[1]; ++j)
    {
      for (int i = 0; i < grid.size[0]; ++i)
      {
        const Vec3 p = grid.gridToWorld({ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z });
        if (norm(p - target) > 10) continue;
        EXPECT_EQ(simple.labels[grid.index(i, j, k)], prepared.labels[grid.index(i, j, k)]);
      }
    }
  }
  const auto tunnels = [](const TissueMap& map)
  {
    int count = 0;
    for (const auto& tissue : tissueTopology(map)) count += tissue.second.tunnels;
    return count;
  };
  EXPECT_LT(3 * tunnels(simple), 2 * tunnels(prepared));
}
