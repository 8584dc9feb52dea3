// SPDX-License-Identifier: Apache-2.0
#include "ScaleField.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace surgicalmesher;

namespace
{

/// Samples of a + b x + c y + d z on an oblique, anisotropic grid: trilinear interpolation is exact for it.
ScaleField affineScale(const Vec3& gradient)
{
  ScaleField scale;
  scale.grid.size = { 4, 3, 5 };
  scale.grid.spacing = { 2, 3, 1.5 };
  scale.grid.origin = { 10, -20, 5 };
  scale.grid.axes = { Vec3{ 0.6, 0.8, 0 }, Vec3{ -0.8, 0.6, 0 }, Vec3{ 0, 0, 1 } };
  for (int k = 0; k < 5; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 4; ++i)
      {
        const Vec3 p{ i * 2.0, j * 3.0, k * 1.5 };
        scale.lengths.push_back(float(50 + dot(gradient, p)));
      }
    }
  }
  return scale;
}

} // namespace

TEST(ScaleField, InterpolatesLinearly)
{
  const Vec3 gradient{ 0.5, -1, 0.25 };
  const ScaleField scale = affineScale(gradient);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  for (int n = 0; n < 1000; ++n)
  {
    const Vec3 p{ 6 * share(random), 6 * share(random), 6 * share(random) };
    EXPECT_NEAR(scale(scale.grid.gridToWorld(p)), 50 + dot(gradient, p), 1e-5);
  }
}

TEST(ScaleField, IsConstantBeyondTheVolume)
{
  const ScaleField scale = affineScale({ 0.5, -1, 0.25 });
  const auto at = [&](const Vec3& p) { return scale(scale.grid.gridToWorld(p)); };
  EXPECT_NEAR(at({ -100, 1, 2 }), at({ 0, 1, 2 }), 1e-9);
  EXPECT_NEAR(at({ 100, 100, 100 }), at({ 6, 6, 6 }), 1e-9);
  EXPECT_NEAR(at({ 1, 1, 1e30 }), at({ 1, 1, 6 }), 1e-9);
}

TEST(ScaleField, HasTheSameNumbersInTheFrameOfAMapWhereverBothLie)
{
  Grid map; // beside the scale's grid, with axes of its own
  map.origin = { 11, -18.75, 6.5 };
  map.axes = { Vec3{ 0.8, 0.6, 0 }, Vec3{ -0.6, 0.8, 0 }, Vec3{ 0, 0, 1 } };
  const ScaleField scale = affineScale({ 0.5, -1, 0.25 });
  const ScaleField seen = inFrameOf(map, scale);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 100; ++n)
  {
    Grid turn; // to anywhere else
    const Vec3 a{ any(random), any(random), any(random) }, b{ any(random), any(random), any(random) };
    turn.axes[0] = a / norm(a);
    turn.axes[2] = cross(a, b) / norm(cross(a, b));
    turn.axes[1] = cross(turn.axes[2], turn.axes[0]);
    turn.origin = { 100 * any(random), 100 * any(random), 100 * any(random) };
    const auto turned = [&turn](Grid grid)
    {
      grid.origin = turn.gridToWorld(grid.origin);
      for (Vec3& axis : grid.axes) axis = turn.gridToWorld(axis) - turn.origin;
      for (int i = 0; i < 3; ++i) grid.spacing[i] *= norm(grid.axes[i]);
      return grid;
    };
    const ScaleField other = inFrameOf(turned(map), ScaleField{ turned(scale.grid), scale.lengths });
    EXPECT_EQ(other.grid.origin, seen.grid.origin);
    EXPECT_EQ(other.grid.spacing, seen.grid.spacing);
    EXPECT_EQ(other.grid.axes, seen.grid.axes);
    const Vec3 p{ 3 * any(random), 3 * any(random), 3 * any(random) };
    EXPECT_EQ(other(p), seen(p));
    EXPECT_NEAR(seen(p), scale(map.gridToWorld(p)), 1e-4);
  }
}

TEST(ScaleField, OwnFramesKeepSmallSpacings)
{
  for (const double spacing : { 1e-7, 1.4e-6, 1.2345e-4, 9.765625e-4, 0.0512345678, 0.4882812 })
  {
    Grid grid;
    grid.spacing = { spacing, 1, 1 };
    EXPECT_NEAR(inOwnFrame(grid).spacing[0], spacing, 2e-5 * spacing);
  }
}

TEST(ScaleField, IsUniformWhereAskedFor)
{
  const ScaleField scale = uniformScale(2.5);
  EXPECT_EQ(scale({ 0, 0, 0 }), 2.5);
  EXPECT_EQ(scale({ -1e6, 4, 1e6 }), 2.5);
}
