// SPDX-License-Identifier: Apache-2.0
#include "TubeLabel.h"

#include "DigitalTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace surgicalmesher;

namespace
{

TissueMap mapOf(const Grid& grid, const std::vector<std::size_t>& voxels)
{
  TissueMap map;
  map.grid = grid;
  map.labels.assign(grid.voxelCount(), 0);
  for (const std::size_t n : voxels) map.labels[n] = 1;
  return map;
}

/// Blocks of 2 x 2 x 2 voxels in which two of the tube, or two of the rest, meet along an edge or at a corner alone.
int selfTouches(const TissueMap& map)
{
  int touches = 0;
  const auto& size = map.grid.size;
  for (int k = 0; k + 1 < size[2]; ++k)
    for (int j = 0; j + 1 < size[1]; ++j)
      for (int i = 0; i + 1 < size[0]; ++i)
      {
        const auto at = [&](int n) { return labelAt(map, { i + (n & 1), j + (n >> 1 & 1), k + (n >> 2) }) != 0; };
        bool isTouch = false;
        for (int a = 0; a < 8; ++a)
        {
          for (const int b : { 3, 5, 6 }) // the two bits in which edge neighbours differ
          {
            const int first = b & -b;
            isTouch = isTouch || (at(a) == at(a ^ b) && at(a ^ first) == at(a ^ (b - first)) && at(a) != at(a ^ first));
          }
          int equal = 0;
          for (int n = 0; n < 8; ++n) equal += at(n) == at(a);
          isTouch = isTouch || (equal == 2 && at(a) == at(a ^ 7));
        }
        touches += isTouch;
      }
  return touches;
}

TubePath coil(double bendRadius, double pitch, double radius, double turns)
{
  TubePath tube;
  for (double angle = 0; angle < turns * 6.2832; angle += 0.05)
  {
    tube.points.push_back(
      { 20 + bendRadius * std::cos(angle), 20 + bendRadius * std::sin(angle), 5 + pitch * angle / 6.2832 });
    tube.radii.push_back(radius);
  }
  tube.flux.assign(tube.points.size(), 1);
  return tube;
}

void expectOneBall(const Grid& grid, const std::vector<std::size_t>& voxels, const std::string& what)
{
  const TissueMap map = mapOf(grid, voxels);
  EXPECT_EQ(tissueTopology(map).at(1), (Betti{ 1, 0, 0 })) << what;
  EXPECT_EQ(selfTouches(map), 0) << what;
}

} // namespace

TEST(TubeLabel, IsOnePieceThatTouchesItselfNowhere)
{
  Grid grid;
  grid.size = { 41, 41, 41 };
  for (const double radius : { 0.3, 0.5, 1.0, 1.7, 2.5 })
  {
    for (const double pitch : { 8.0, 5.0, 3.0, 1.5 }) // down to turns that run into each other
      expectOneBall(grid, tubeVoxels(grid, coil(8, pitch, radius, 3)),
                    "radius " + std::to_string(radius) + ", pitch " + std::to_string(pitch));
  }
}

TEST(TubeLabel, IsOnePieceOnRandomWalksThroughAnyGrid)
{
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int draw = 0; draw < 12; ++draw)
  {
    Grid grid;
    grid.size = { 40, 40, 20 };
    grid.spacing = { 1, 1, 2 };
    TubePath tube;
    Vec3 p{ 20, 20, 20 };
    Vec3 v{ 1, 0, 0 };
    for (int n = 0; n < 60; ++n)
    {
      tube.points.push_back(p);
      tube.radii.push_back(0.8 + 0.6 * std::abs(std::sin(0.2 * n)));
      v += 0.6 * Vec3{ normal(random), normal(random), normal(random) };
      v = v / norm(v);
      p += 0.7 * v;
    }
    tube.flux.assign(tube.points.size(), 1);
    expectOneBall(grid, tubeVoxels(grid, tube), "draw " + std::to_string(draw));
  }
}

TEST(TubeLabel, HoldsTheVoxelsOfTheTubeAndItsEnds)
{
  Grid grid;
  grid.size = { 40, 20, 20 };
  TubePath tube;
  for (double x = 8; x <= 30; x += 0.5) tube.points.push_back({ x, 10.2, 9.7 });
  tube.radii.assign(tube.points.size(), 3);
  tube.flux.assign(tube.points.size(), 1);
  const TissueMap map = mapOf(grid, tubeVoxels(grid, tube));
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 8; i <= 30; ++i)
      {
        const double distance = std::hypot(j - 10.2, k - 9.7);
        if (std::abs(distance - 3) < 0.05) continue;
        EXPECT_EQ(labelAt(map, { i, j, k }) != 0, distance < 3) << i << " " << j << " " << k;
      }
}

TEST(TubeLabel, LeavesOutWhatLiesOutsideTheMap)
{
  Grid grid;
  grid.size = { 20, 20, 20 };
  TubePath tube;
  for (double x = -15; x <= 10; x += 0.5) tube.points.push_back({ x, 10, 10 });
  tube.radii.assign(tube.points.size(), 2);
  tube.flux.assign(tube.points.size(), 1);
  const std::vector<std::size_t> voxels = tubeVoxels(grid, tube);
  EXPECT_FALSE(voxels.empty());
  EXPECT_LT(voxels.back(), grid.voxelCount());
  tube.points.resize(10);
  tube.radii.resize(10);
  EXPECT_TRUE(tubeVoxels(grid, tube).empty());
}
