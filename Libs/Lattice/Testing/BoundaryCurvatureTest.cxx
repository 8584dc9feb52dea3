// SPDX-License-Identifier: Apache-2.0
#include "BoundaryCurvature.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surgicalmesher
{
namespace
{

using namespace test;

TissueMap ball(double radius, const Vec3& spacing = { 1, 1, 1 })
{
  std::array<int, 3> middle, size;
  for (int a = 0; a < 3; ++a)
  {
    middle[a] = int(std::ceil(radius / spacing[a])) + 2;
    size[a] = 2 * middle[a] + 1;
  }
  const auto paint = [&](int i, int j, int k)
  {
    const Vec3 p{ (i - middle[0]) * spacing.x, (j - middle[1]) * spacing.y, (k - middle[2]) * spacing.z };
    return norm(p) <= radius ? 1 : 0;
  };
  return paintedMap(size, paint, spacing);
}

double mean(const std::vector<CurvedVoxel>& curved)
{
  double sum = 0;
  for (const CurvedVoxel& c : curved) sum += c.curvature / double(curved.size());
  return sum;
}

} // namespace

TEST(BoundaryCurvature, OfABallIsOneOverItsRadius)
{
  for (const double radius : { 6., 10., 20. })
  {
    const std::vector<CurvedVoxel> curved = boundaryCurvatures(ball(radius), 0.7);
    EXPECT_NEAR(mean(curved) * radius, 1, 0.15) << radius;
    for (const CurvedVoxel& c : curved) EXPECT_NEAR(c.curvature * radius, 1, 0.25) << radius;
  }
}

TEST(BoundaryCurvature, IsInMillimetres)
{
  EXPECT_NEAR(mean(boundaryCurvatures(ball(5, { 0.5, 0.5, 0.5 }), 0.7)), 1. / 5, 0.03);
  EXPECT_NEAR(mean(boundaryCurvatures(ball(20, { 1, 1, 2 }), 0.7)), 1. / 20, 0.02);
}

TEST(BoundaryCurvature, ABoxHasNone)
{
  const TissueMap map = paintedMap({ 24, 24, 24 },
                                   [](int i, int j, int k) {
                                     return std::min({ i, j, k }) >= 4 && std::max({ i, j, k }) < 20 ? 1 : 0;
                                   });
  for (const CurvedVoxel& c : boundaryCurvatures(map, 0.7))
  {
    const auto [i, j, k] = map.grid.voxelAt(c.voxel);
    const auto isEnd = [](int x) { return x < 7 || x > 16; };
    if (isEnd(i) && isEnd(j) && isEnd(k)) continue; // a corner is round at this scale
    EXPECT_LT(c.curvature, 0.04) << i << " " << j << " " << k;
  }
}

TEST(BoundaryCurvature, OfATubeIsThatAcrossIt)
{
  const TissueMap map =
    paintedMap({ 30, 30, 40 }, [](int i, int j, int) { return std::hypot(i - 15, j - 15) < 8 ? 1 : 0; });
  double sum = 0;
  int count = 0;
  for (const CurvedVoxel& c : boundaryCurvatures(map, 0.7))
    if (const int k = map.grid.voxelAt(c.voxel)[2]; k > 8 && k < 32) sum += c.curvature, ++count;
  EXPECT_NEAR(sum / count, 1. / 8, 0.02);
}

} // namespace surgicalmesher
