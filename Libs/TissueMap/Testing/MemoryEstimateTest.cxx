// SPDX-License-Identifier: Apache-2.0
#include "MemoryEstimate.h"
#include "Errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace surgicalmesher;

namespace
{

/// Background around slabs of tissue 1, 2, 3 ... of equal thickness along i.
TissueMap slabs(int size, int count, const Vec3& spacing = { 1, 1, 1 })
{
  TissueMap map;
  map.grid.size = { size, size, size };
  map.grid.spacing = spacing;
  for (int k = 0; k < size; ++k)
  {
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        const bool isInside = std::min({ i, j, k }) >= 2 && std::max({ i, j, k }) < size - 2;
        map.labels.push_back(isInside ? Label(1 + (i - 2) * count / (size - 4)) : Label(0));
      }
    }
  }
  return map;
}

double estimate(const TissueMap& map, double length)
{
  const ScaleField scale = uniformScale(length);
  return double(estimateSurfaceMemory(map, scale, startingFaces(map, scale, false)));
}

TEST(MemoryEstimate, GrowsWithTheInterfaceBetweenTissues)
{
  const double one = estimate(slabs(44, 1), 8), two = estimate(slabs(44, 2), 8), four = estimate(slabs(44, 4), 8);
  EXPECT_GT(two, one);
  EXPECT_NEAR((four - one) / (two - one), 3, 1e-6); // three walls of the same size instead of one
}

TEST(MemoryEstimate, GrowsAsElementsShrink)
{
  const TissueMap map = slabs(44, 2);
  EXPECT_EQ(estimate(map, 2.4), estimate(map, 2.0)); // cubes of one voxel for both
  EXPECT_GT(estimate(map, 1.2), estimate(map, 2.4));
  EXPECT_NEAR((estimate(map, 0.6) - estimate(map, 1.2)) / (estimate(map, 1.2) - estimate(map, 2.4)), 8, 1e-6);
}

TEST(MemoryEstimate, ReadingTakesMoreThanMeshingWhereVoxelsRepeatOften)
{
  const TissueMap map = slabs(44, 2);
  const auto readingAll = [&](int times)
  {
    Grid file = map.grid;
    for (int& n : file.size) n *= times;
    return double(estimateReadingMemory(file));
  };
  EXPECT_LT(readingAll(1), estimate(map, 8));
  EXPECT_GT(readingAll(8), estimate(map, 8));
}

TEST(MemoryEstimate, CountsTheScale)
{
  const TissueMap map = slabs(44, 2);
  ScaleField fine = uniformScale(8);
  fine.grid.size = { 100, 100, 100 };
  fine.lengths.assign(1000000, 8);
  EXPECT_NEAR(double(estimateSurfaceMemory(map, fine, 0)) - double(estimateSurfaceMemory(map, uniformScale(8), 0)),
              16 * 999999.0, 1);
}

TEST(MemoryEstimate, DoesNotDependOnUnits)
{
  const double finer = estimate(slabs(44, 2, { 0.5, 0.5, 0.5 }), 1), coarser = estimate(slabs(44, 2, { 2, 2, 2 }), 4);
  EXPECT_EQ(finer, coarser);
}

TEST(MemoryEstimate, CutsLongVoxels)
{
  const double flat = estimate(slabs(24, 2, { 1, 1, 3 }), 2), cube = estimate(slabs(24, 2), 2);
  EXPECT_GT(flat, cube);
  EXPECT_LT(flat, 3 * cube);
}

TEST(MemoryEstimate, TakesFewSamplesOfLargeMaps)
{
  // The same piece of tissue, sampled at every voxel of a small map and at some of a large one.
  const double whole = estimate(slabs(64, 1), 1) - estimate(slabs(64, 1), 8);
  const double sampled = estimate(slabs(160, 1), 1) - estimate(slabs(160, 1), 8);
  EXPECT_NEAR(sampled / whole, std::pow(156.0 / 60.0, 3), 0.1 * std::pow(156.0 / 60.0, 3));
}

TEST(StartingFaces, AreThoseOfBlocksWhereElementsAreLong)
{
  const TissueMap map = slabs(44, 2);
  const double voxels = startingFaces(map, uniformScale(16), false);
  EXPECT_EQ(startingFaces(map, uniformScale(7), true), voxels);
  EXPECT_EQ(startingFaces(map, uniformScale(8), true), voxels / 4);
  EXPECT_EQ(startingFaces(map, uniformScale(16), true), voxels / 16);
  EXPECT_EQ(startingFaces(map, uniformScale(1000), true), voxels / 64);
}

TEST(StartingFaces, CountThoseOfACube)
{
  TissueMap map;
  map.grid.size = { 3, 3, 3 };
  map.labels.assign(27, 1);
  EXPECT_EQ(startingFaces(map, uniformScale(1)), 6 * 9);
}

TEST(RequireMemory, RefusesWithBothFigures)
{
  try
  {
    requireMemory(14'300'000'000, 7'800'000'000, "head.nrrd");
    FAIL() << "not refused";
  }
  catch (const InputError& error)
  {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind("head.nrrd: ", 0), 0u) << message;
    EXPECT_NE(message.find("14.3 GB"), std::string::npos) << message;
    EXPECT_NE(message.find("7.8 GB"), std::string::npos) << message;
  }
}

TEST(RequireMemory, AcceptsWhatFitsAndWhatNobodyKnows)
{
  EXPECT_NO_THROW(requireMemory(5, 5, "map"));
  EXPECT_NO_THROW(requireMemory(std::uint64_t(1) << 62, std::nullopt, "map"));
}

} // namespace
