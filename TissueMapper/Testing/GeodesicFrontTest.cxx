// SPDX-License-Identifier: Apache-2.0
#include "GeodesicFront.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace surgicalmesher;

TEST(GeodesicFront, GoesRoundAWallInMillimetresAndStopsAtItsLimit)
{
  // A row of nine voxels, 2 mm apart, and one beside it by which the front passes the closed one in its middle.
  Grid grid;
  grid.size = { 9, 2, 1 };
  grid.spacing = { 2, 1, 1 };
  std::vector<bool> isOpen(18, false);
  std::fill(isOpen.begin(), isOpen.begin() + 9, true);
  isOpen[4] = false;
  const auto count = [&](double limit)
  {
    const std::vector<bool> reached = reachedFrom(grid, { 0 }, isOpen, limit);
    return std::count(reached.begin(), reached.end(), true);
  };
  EXPECT_EQ(count(0), 4);
  isOpen[9 + 4] = true;
  EXPECT_EQ(count(0), 9);
  EXPECT_EQ(count(6), 4);                     // three steps of 2 mm
  EXPECT_EQ(count(6 + 2 * 2.2361 + 1e-3), 6); // and two over an edge
  EXPECT_EQ(std::count(isOpen.begin(), isOpen.end(), true), 9);
  const std::vector<bool> none = reachedFrom(grid, { 17 }, isOpen, 0);
  EXPECT_EQ(std::count(none.begin(), none.end(), true), 0); // a seed that isn't open
}
