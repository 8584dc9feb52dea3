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

TEST(ScaleField, IsUniformWhereAskedFor)
{
  const ScaleField scale = uniformScale(2.5);
  EXPECT_EQ(scale({ 0, 0, 0 }), 2.5);
  EXPECT_EQ(scale({ -1e6, 4, 1e6 }), 2.5);
}
