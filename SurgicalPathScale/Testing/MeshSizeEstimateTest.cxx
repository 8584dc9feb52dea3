// SPDX-License-Identifier: Apache-2.0
#include "MeshSizeEstimate.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace surgicalmesher;

namespace
{

/// A plate of `thickness` voxels in the middle of a cube of 64 mm.
TissueMap plate(int thickness)
{
  TissueMap map;
  map.grid.size = { 64, 64, 64 };
  map.labels.assign(map.grid.voxelCount(), 0);
  for (int k = 32 - thickness / 2; k < 32 - thickness / 2 + thickness; ++k)
  {
    for (int j = 0; j < 64; ++j)
    {
      for (int i = 0; i < 64; ++i) map.labels[map.grid.index(i, j, k)] = 1;
    }
  }
  return map;
}

} // namespace

TEST(MeshSizeEstimate, ScalesWithTheEdgeLengthInTheBulk)
{
  const TissueMap map = plate(64);
  const MeshSizeEstimate coarse = estimateMeshSize(map, uniformScale(2));
  const MeshSizeEstimate fine = estimateMeshSize(map, uniformScale(1));
  EXPECT_NEAR(fine.triangles / coarse.triangles, 4, 0.01);
  EXPECT_GT(fine.tetrahedra / coarse.tetrahedra, 7);
  EXPECT_LE(fine.tetrahedra / coarse.tetrahedra, 8);
  const double regular = 64.0 * 64 * 64 * 6 * std::sqrt(2.0); // of regular tetrahedra of edge 1
  EXPECT_GT(fine.tetrahedra / regular, 1 / 1.5);
  EXPECT_LT(fine.tetrahedra / regular, 1.5);
}

TEST(MeshSizeEstimate, CountsEveryInterfaceOnce)
{
  TissueMap map = plate(64);
  const MeshSizeEstimate one = estimateMeshSize(map, uniformScale(2));
  for (int k = 32; k < 64; ++k)
  {
    for (int j = 0; j < 64; ++j)
    {
      for (int i = 0; i < 64; ++i) map.labels[map.grid.index(i, j, k)] = 2;
    }
  }
  const MeshSizeEstimate two = estimateMeshSize(map, uniformScale(2));
  EXPECT_NEAR(two.triangles / one.triangles, 7.0 / 6.0, 0.01);
}

TEST(MeshSizeEstimate, GivesSmallTissuesTheElementsTheyNeed)
{
  TissueMap map = plate(0);
  for (int n = 0; n < 64; ++n) // cubes of 3 mm, 16 mm apart
  {
    const std::array<int, 3> corner{ 6 + 16 * (n % 4), 6 + 16 * (n / 4 % 4), 6 + 16 * (n / 16) };
    for (int v = 0; v < 27; ++v)
      map.labels[map.grid.index(corner[0] + v % 3, corner[1] + v / 3 % 3, corner[2] + v / 9)] = 1;
  }
  const MeshSizeEstimate estimate = estimateMeshSize(map, uniformScale(8));
  EXPECT_GT(estimate.triangles, 64 * 4); // the least that closes a surface
  EXPECT_LT(estimate.triangles, 64 * 50);
  EXPECT_GT(estimate.tetrahedra, 64);
}

TEST(MeshSizeEstimate, DoesNotDependOnHowFineTheVoxelsAre)
{
  TissueMap map = plate(0);
  for (std::size_t n = 0; n < map.labels.size(); ++n)
  {
    const auto [i, j, k] = map.grid.voxelAt(n);
    const int x = i - 30, y = j - 33, z = k - 32;
    map.labels[n] = Label(x * x + y * y + z * z < 400 ? 1 : i > 40 && k > 11 && k < 14 ? 2 : 0); // a ball and a sheet
  }
  TissueMap fine;
  fine.grid.size = { 128, 128, 128 };
  fine.grid.spacing = { 0.5, 0.5, 0.5 };
  for (std::size_t n = 0; n < fine.grid.voxelCount(); ++n)
  {
    const auto [i, j, k] = fine.grid.voxelAt(n);
    fine.labels.push_back(map.labels[map.grid.index(i / 2, j / 2, k / 2)]);
  }
  const MeshSizeEstimate one = estimateMeshSize(map, uniformScale(3)), other = estimateMeshSize(fine, uniformScale(3));
  EXPECT_NEAR(other.triangles / one.triangles, 1, 1e-6);
  EXPECT_NEAR(other.tetrahedra / one.tetrahedra, 1, 1e-6);
}

TEST(MeshSizeEstimate, IsZeroForAnEmptyMap)
{
  const MeshSizeEstimate none = estimateMeshSize(plate(0), uniformScale(1));
  EXPECT_EQ(none.triangles, 0);
  EXPECT_EQ(none.tetrahedra, 0);
}
