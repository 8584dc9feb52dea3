// SPDX-License-Identifier: Apache-2.0
#include "SampleTolerances.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

namespace surgicalmesher
{
namespace
{

constexpr double voxel = 0.5;           // mm
constexpr double thick = 100, thin = 2; // mm

/// Tissue 1 below, tissue 2 above, in a grid of cubes.
TissueMap layers()
{
  TissueMap map = test::paintedMap({ 8, 8, 8 }, [](int, int, int k) { return k < 4 ? 1 : 2; });
  map.grid.spacing = { voxel, voxel, voxel };
  return map;
}

/// mm, of a sample between the layers, where L is `length` mm; tissue 2 is `thickness` mm thick.
double toleranceAt(double length, const ToleranceOptions& options, double thickness = thick)
{
  BackgroundMesh background;
  background.samples.emplace_back();
  background.samples[0].position = { 4 * voxel, 4 * voxel, 3.5 * voxel };
  setTolerances(
    background, layers(), { { 1, thick }, { 2, thickness } }, [&](const Vec3&) { return length; }, options);
  return background.samples[0].tolerance;
}

ToleranceOptions onSmoothBoundary()
{
  ToleranceOptions options;
  options.isSmooth = true;
  return options;
}

TEST(SampleTolerances, NeverFallAsLGrows)
{
  for (const bool isSmooth : { false, true })
  {
    ToleranceOptions options;
    options.isSmooth = isSmooth;
    double before = 0;
    for (double length = 0.1; length < 40; length *= 1.1)
    {
      const double tolerance = toleranceAt(length, options);
      EXPECT_GT(tolerance, 0) << length;
      EXPECT_GE(tolerance, before) << length;
      before = tolerance;
    }
  }
}

TEST(SampleTolerances, ShareOfLAloneEndsAtTwoVoxels)
{
  const ToleranceOptions options = onSmoothBoundary();
  EXPECT_LT(toleranceAt(20 * voxel, options), 2 * voxel);
  for (const double voxels : { 25, 28, 32 })
    EXPECT_NEAR(toleranceAt(voxels * voxel, options), 2 * voxel, 1e-6) << voxels;
}

TEST(SampleTolerances, ThinTissuesAreHeldCloserAndNoCloserThanVoxelsTell)
{
  const ToleranceOptions options = onSmoothBoundary();
  const double usual = toleranceAt(10, options);
  EXPECT_NEAR(toleranceAt(10, options, thin), 0.28 * thin, 1e-6);
  EXPECT_LT(0.28 * thin, usual);
  EXPECT_NEAR(toleranceAt(10, options, 0.1 * voxel), 0.6 * voxel, 1e-6);
}

TEST(SampleTolerances, AreWithinTheBoundThatIsAskedFor)
{
  ToleranceOptions options = onSmoothBoundary();
  options.maximumDistance = 0.1;
  EXPECT_NEAR(toleranceAt(10, options), 0.1, 1e-6);
  EXPECT_NEAR(toleranceAt(10, options, thin), 0.1, 1e-6);
}

TEST(SampleTolerances, FollowProximityBetweenShortestAndLongest)
{
  ToleranceOptions options = onSmoothBoundary();
  options.proximity = { 0.25, 2.25 };
  options.shortest = 1;
  options.longest = 9;
  EXPECT_NEAR(toleranceAt(0.5, options), 0.25, 1e-6);
  EXPECT_NEAR(toleranceAt(5, options), 1.25, 1e-6);
  EXPECT_NEAR(toleranceAt(20, options), 2.25, 1e-6);
}

} // namespace
} // namespace surgicalmesher
