// SPDX-License-Identifier: Apache-2.0
#include "TissueScale.h"

#include "ScaleMaps.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <random>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// A sheet of 1, `thickness` voxels thick, under a block of 2.
TissueMap sheetOf(int thickness)
{
  return paintedMap({ 30, 30, 30 },
                    [=](int i, int j, int k)
                    {
                      if (std::min({ i, j }) < 2 || std::max({ i, j }) >= 28 || k < 3) return 0;
                      return k < 3 + thickness ? 1 : k < 27 ? 2 : 0;
                    });
}

TissueSetting lengths(double minimum, double maximum, TissueRole role = TissueRole::Mesh)
{
  TissueSetting setting;
  setting.role = role;
  setting.minimumEdgeLength = minimum;
  setting.maximumEdgeLength = maximum;
  return setting;
}

/// Calls visit(label, place) at the centres and corners of all voxels of tissues.
template <typename Visit>
void visitPlaces(const TissueMap& map, const Visit& visit)
{
  const Vec3& s = map.grid.spacing;
  for (int k = 0; k < map.grid.size[2]; ++k)
  {
    for (int j = 0; j < map.grid.size[1]; ++j)
    {
      for (int i = 0; i < map.grid.size[0]; ++i)
      {
        const Label label = map.labels[map.grid.index(i, j, k)];
        if (label == 0) continue;
        for (int corner = 0; corner < 9; ++corner)
        {
          const auto shift = [&](int bit) { return corner == 8 ? 0.0 : corner >> bit & 1 ? 0.5 : -0.5; };
          visit(label, map.grid.gridToWorld({ (i + shift(0)) * s.x, (j + shift(1)) * s.y, (k + shift(2)) * s.z }));
        }
      }
    }
  }
}

} // namespace

TEST(LocalThickness, SheetIsAsThickAsItIs)
{
  for (const int thickness : { 1, 2, 3, 5 })
  {
    const TissueMap map = sheetOf(thickness);
    const LocalThickness found = measureThickness(map, uniformScale(6));
    const double facing = 2 * 26 * 26 / found.tissues.at(1).area; // the rest is rim
    EXPECT_GT(found.tissues.at(1).thinArea / found.tissues.at(1).area, thickness <= 3 ? 0.98 : 0.8 * facing)
      << thickness;
    std::vector<float> values;
    for (const ThinVoxel& thin : found.thinVoxels)
    {
      if (map.labels[thin.voxel] == 1) values.push_back(thin.thickness);
    }
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    EXPECT_NEAR(values[values.size() / 2], thickness, 0.3);
  }
}

TEST(LocalThickness, NothingIsThinWhereTheLengthIsSmaller)
{
  const TissueMap map = sheetOf(5);
  const LocalThickness found = measureThickness(map, uniformScale(3));
  EXPECT_EQ(found.tissues.at(1).thinArea, 0);
  EXPECT_EQ(found.tissues.at(1).smallest, 0);
  EXPECT_NEAR(found.tissues.at(1).area, 2 * 26 * 26 + 4 * 26 * 5, 1e-9);
  EXPECT_TRUE(found.thinVoxels.empty());
}

TEST(LocalThickness, BallIsAsThickAsItsDiameterWhateverTheVoxels)
{
  const Vec3 spacing{ 1, 0.8, 1.25 };
  const TissueMap map = paintedMap(
    { 24, 30, 20 },
    [&](int i, int j, int k) {
      return norm({ (i - 11.5) * spacing.x, (j - 14.5) * spacing.y, (k - 9.5) * spacing.z }) < 6;
    },
    spacing);
  const TissueThickness thin = measureThickness(map, uniformScale(14)).tissues.at(1);
  const TissueThickness thick = measureThickness(map, uniformScale(9)).tissues.at(1);
  EXPECT_GT(thin.thinArea, 0.95 * thin.area);
  EXPECT_LT(thick.thinArea, 0.05 * thick.area);
}

TEST(TissueScale, LimitsHoldOnTheWholeTissueAndItsSurface)
{
  TissueMap map = sheetOf(4);
  map.grid.origin = { -3, 7, 11 };
  map.grid.axes = { Vec3{ 0.8, 0.6, 0 }, Vec3{ -0.6, 0.8, 0 }, Vec3{ 0, 0, 1 } };
  ScaleField scale = radialScale(map.grid, map.grid.gridToWorld({ 15, 15, 15 }), 2, 8, 3, 10);
  const double gradation = 0.3;
  const ScaleField limited = followTissues(scale, map, { { 1, lengths(2.5, 3.5) } }, gradation);
  visitPlaces(map,
              [&](Label label, const Vec3& p)
              {
                if (label != 1) return;
                EXPECT_LE(limited(p), 3.5 + 1e-5);
                EXPECT_GE(limited(p), 2.5 - 1e-5);
              });
  const ScaleField same = followTissues(scale, map, { { 1, lengths(0, 0) } }, gradation);
  EXPECT_EQ(same.lengths, scale.lengths);
}

TEST(TissueScale, RisesSlowlyFromWhereItWasLowered)
{
  const TissueMap map = sheetOf(4);
  const ScaleField scale = scaleVolume(uniformScale(8), map.grid);
  const double gradation = 0.3;
  const ScaleField limited = followTissues(scale, map, { { 1, lengths(0, 2) } }, gradation);
  EXPECT_NEAR(limited({ 15, 15, 5 }), 2, 1e-5);
  for (double z = 6; z < 29; z += 0.5)
  {
    const double rise = limited({ 15, 15, z + 0.5 }) - limited({ 15, 15, z });
    EXPECT_GE(rise, -1e-5);
    EXPECT_LE(rise, 0.5 * gradation + 1e-5);
  }
  EXPECT_GT(limited({ 15, 15, 29 }), 6);
}

TEST(TissueScale, ShellHasOneLength)
{
  const TissueMap map = sheetOf(4);
  const ScaleField scale = radialScale(map.grid, { 15, 15, 15 }, 1, 8, 3, 10);
  TissueSettings settings{ { 1, lengths(0, 0, TissueRole::Shell) }, { 2, lengths(1.2, 1.8) } };
  double least = 8;
  visitPlaces(map, [&](Label label, const Vec3& p) { least = label == 1 ? std::min(least, scale(p)) : least; });
  completeShells(settings, map, scale);
  const double length = settings.at(1).maximumEdgeLength;
  EXPECT_GE(length, least);
  EXPECT_LE(length, least + 1);
  const ScaleField limited = followTissues(scale, map, settings, 0.3);
  visitPlaces(map,
              [&](Label label, const Vec3& p)
              {
                if (label != 1) return;
                EXPECT_NEAR(limited(p), length, 1e-5);
              });
}

TEST(TissueScale, ThinTissueBringsItsThickness)
{
  const TissueMap map = sheetOf(2);
  const ScaleField graded = radialScale(map.grid, { 15, 15, 28 }, 1, 6, 0, 4);
  const LocalThickness thickness = measureThickness(map, graded);
  const ScaleField limited = followThickness(graded, map, thickness.thinVoxels, 0.3);
  EXPECT_LT(limited({ 15, 15, 4 }), 2.4);
  for (std::size_t n = 0; n < limited.lengths.size(); ++n)
  {
    EXPECT_LE(limited.lengths[n], graded.lengths[n]);
    EXPECT_GE(limited.lengths[n], 1) << "below the voxel spacing";
  }
}

TEST(TissueScale, FlatTissueGetsEdgesOfTwiceItsThickness)
{
  const TissueMap map = sheetOf(2);
  const auto thickness = meanThickness(map);
  EXPECT_NEAR(thickness.at(1), 2, 1.0) << "the staircase allowance is half the thickness of an even sheet";
  EXPECT_GT(thickness.at(2), 5);
  const ScaleField coarse = uniformScale(9), fine = uniformScale(4);
  const ScaleField limited = followSmallTissues(coarse, map, thickness);
  visitPlaces(map,
              [&](Label label, const Vec3& p)
              {
                if (label != 1) return;
                EXPECT_LE(limited(p), 2 * thickness.at(1) + 1e-4);
              });
  EXPECT_FLOAT_EQ(limited({ 15, 15, 22 }), 9) << "thick tissue";
  EXPECT_EQ(followSmallTissues(fine, map, thickness).lengths, fine.lengths) << "not flat for its edges";
}

TEST(TissueScale, TissueSmallAllRoundGetsEdgesOfItsSize)
{
  const TissueMap map = paintedMap({ 40, 40, 40 },
                                   [](int i, int j, int k) {
                                     return std::max({ i, j, k }) < 8 ? 2 : 1;
                                   });
  const auto thickness = meanThickness(map);
  const ScaleField limited = followSmallTissues(uniformScale(16), map, thickness);
  EXPECT_NEAR(limited({ 4, 4, 4 }), 8 / 0.75, 1e-4);
  EXPECT_LT(limited({ 12, 4, 4 }), 16) << "rises slowly around it";
  EXPECT_FLOAT_EQ(limited({ 35, 35, 35 }), 16) << "large tissue";
  const ScaleField usual = uniformScale(8);
  EXPECT_EQ(followSmallTissues(usual, map, thickness).lengths, usual.lengths) << "no more than eight voxels";
  const TissueMap dot = paintedMap({ 40, 40, 40 }, [](int i, int j, int k) { return i + j + k == 0 ? 2 : 1; });
  EXPECT_NEAR(followSmallTissues(uniformScale(16), dot, meanThickness(dot))({ 0, 0, 0 }), 8, 1e-4);
}

TEST(TissueScale, VolumeOfAUniformScaleCoversTheMap)
{
  for (const int size : { 1, 2, 5, 8 })
  {
    const TissueMap map = paintedMap({ size, 3, 4 }, [](int, int, int) { return 1; }, { 1, 0.5, 2 });
    const ScaleField volume = scaleVolume(uniformScale(2.5), map.grid);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double first = volume.grid.origin[axis];
      const double last = first + (volume.grid.size[axis] - 1) * volume.grid.spacing[axis];
      EXPECT_LE(first, -0.5 * map.grid.spacing[axis]);
      EXPECT_GE(last, (map.grid.size[axis] - 0.5) * map.grid.spacing[axis]);
    }
    EXPECT_EQ(volume.lengths, std::vector<float>(volume.grid.voxelCount(), 2.5f));
  }
}

TEST(TissueScale, FollowsCurvatureWithinItsBounds)
{
  const TissueMap map = sheetOf(3);
  const auto voxel = [&](int i, int j, int k) { return map.grid.index(i, j, k); };
  const std::vector<CurvedVoxel> curved{ { voxel(6, 6, 6), 0.1 }, { voxel(20, 6, 6), 0 }, { voxel(6, 20, 20), 100 } };
  const ScaleField followed = followCurvature(uniformScale(6), map, curved, 0.2, 0.5);
  EXPECT_NEAR(followed({ 6, 6, 6 }), 4, 1e-5);   // sqrt(8 0.2 / 0.1)
  EXPECT_NEAR(followed({ 20, 6, 6 }), 6, 1e-5);  // flat
  EXPECT_NEAR(followed({ 6, 20, 20 }), 1, 1e-5); // the voxel spacing
  EXPECT_NEAR(followed({ 6, 6, 10 }), 6, 0.6);   // by the gradation
  EXPECT_GT(followed({ 6, 6, 10 }), followed({ 6, 6, 8 }));
  const ScaleField tight = followCurvature(uniformScale(3), map, curved, 0.2, 0.5);
  EXPECT_NEAR(tight({ 6, 6, 6 }), 3, 1e-5); // it is short enough
}
