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

MeshingSize sizeOf(const TissueMap& map, double length, bool hasBlocks = false)
{
  return meshingSize(map, uniformScale(length), hasBlocks);
}

double estimate(const TissueMap& map, double length) { return double(estimateSurfaceMemory(sizeOf(map, length))); }

TEST(MemoryEstimate, GrowsWithTheInterfaceBetweenTissues)
{
  const auto faces = [](int count) { return sizeOf(slabs(44, count), 8).startingFaces; };
  EXPECT_EQ(faces(2) - faces(1), 1600);
  EXPECT_EQ(faces(4) - faces(1), 3 * 1600); // three walls of the same size
  EXPECT_GT(estimate(slabs(144, 64), 8), estimate(slabs(144, 1), 8));
}

TEST(MemoryEstimate, GrowsAsElementsShrink)
{
  const TissueMap map = slabs(44, 2);
  const auto cubes = [&](double length) { return sizeOf(map, length).startingCubes; };
  EXPECT_EQ(cubes(2.4), cubes(2.0)); // of one voxel for both
  EXPECT_EQ(cubes(2.4), 40 * 40 * 40);
  EXPECT_EQ(cubes(1.2), 8 * cubes(2.4));
  EXPECT_EQ(cubes(0.6), 64 * cubes(2.4));
  double before = 0;
  for (const double length : { 4.0, 2.0, 1.0, 0.5 })
  {
    EXPECT_GT(estimate(map, length), before) << length;
    before = estimate(map, length);
  }
}

TEST(MemoryEstimate, CountsTetrahedraByVolumeAndArea)
{
  const double volume = 40 * 40 * 40, outer = 6 * 1600, wall = 1600;
  for (const double length : { 1.0, 2.5, 7.0 })
  {
    const double perVolume = 1 / (0.12 * length * length * length), perArea = 6 / (length * length);
    const double one = sizeOf(slabs(44, 1), length).tetrahedra;
    EXPECT_NEAR(one, volume * perVolume + outer * 13 / (length * length), 1e-9 * one);
    EXPECT_NEAR(sizeOf(slabs(44, 2), length).tetrahedra, one + wall * perArea, 1e-9 * one);
  }
}

TEST(MemoryEstimate, GivesNoEdgesShorterThanVoxelsDo)
{
  const TissueMap map = slabs(24, 2, { 1, 1, 3 });
  const double shortest = shortestLatticeLength(map.grid);
  EXPECT_EQ(shortest, 0.25);
  for (const double length : { 0.01, 1e-30 })
    EXPECT_EQ(sizeOf(map, length).tetrahedra, sizeOf(map, shortest).tetrahedra) << length;
  EXPECT_GT(sizeOf(map, shortest).tetrahedra, sizeOf(map, 2 * shortest).tetrahedra);
}

TEST(MemoryEstimate, GrowsWithAllThatIsThereAtOneTime)
{
  MeshingSize start, end;
  start.samples = start.startingFaces = start.startingCubes = end.tetrahedra = 1e6;
  const auto more = [&](double MeshingSize::*count, MeshingSize size)
  {
    const double before = double(estimateSurfaceMemory(size));
    size.*count += 1e6;
    return (double(estimateSurfaceMemory(size)) - before) / 1e6;
  };
  EXPECT_EQ(more(&MeshingSize::samples, start), 230);
  EXPECT_EQ(more(&MeshingSize::startingFaces, start), 440);
  EXPECT_EQ(more(&MeshingSize::startingCubes, start), 370);
  EXPECT_EQ(more(&MeshingSize::tetrahedra, start), 0);
  EXPECT_EQ(more(&MeshingSize::tetrahedra, end), 500);
  EXPECT_EQ(more(&MeshingSize::samples, end), 0);
}

TEST(MemoryEstimate, OfTetrahedraIsTheMoreWhereElementsAreSmall)
{
  const TissueMap map = slabs(84, 1);
  EXPECT_GT(estimateTetrahedralMemory(sizeOf(map, 1)), estimateSurfaceMemory(sizeOf(map, 1)));
  EXPECT_LT(estimateTetrahedralMemory(sizeOf(map, 8)), estimateSurfaceMemory(sizeOf(map, 8)));
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
  EXPECT_NEAR(double(estimateSurfaceMemory(meshingSize(map, fine, false))) - estimate(map, 8), 16 * 999999.0, 1);
}

TEST(MemoryEstimate, DoesNotDependOnUnits)
{
  const double finer = estimate(slabs(44, 2, { 0.5, 0.5, 0.5 }), 1), coarser = estimate(slabs(44, 2, { 2, 2, 2 }), 4);
  EXPECT_EQ(finer, coarser);
}

TEST(MemoryEstimate, CutsLongVoxels)
{
  const MeshingSize flat = sizeOf(slabs(24, 2, { 1, 1, 3 }), 2), cube = sizeOf(slabs(24, 2), 2);
  EXPECT_GT(flat.startingFaces, cube.startingFaces);
  EXPECT_LT(flat.startingFaces, 3 * cube.startingFaces);
  EXPECT_NEAR(flat.startingCubes, 3 * cube.startingCubes, 1e-6);
  EXPECT_GT(flat.tetrahedra, cube.tetrahedra);
  EXPECT_LT(flat.tetrahedra, 3 * cube.tetrahedra);
}

TEST(MemoryEstimate, TakesFewSamplesOfLargeMaps)
{
  // The same piece of tissue, sampled at every voxel of a small map and at some of a large one.
  const double whole = sizeOf(slabs(64, 1), 1).startingCubes, sampled = sizeOf(slabs(160, 1), 1).startingCubes;
  EXPECT_NEAR(sampled / whole, std::pow(156.0 / 60.0, 3), 0.1 * std::pow(156.0 / 60.0, 3));
}

TEST(StartingFaces, AreThoseOfBlocksWhereElementsAreLong)
{
  const TissueMap map = slabs(44, 2);
  const auto faces = [&](double length) { return sizeOf(map, length, true).startingFaces; };
  const double voxels = sizeOf(map, 16).startingFaces;
  EXPECT_EQ(faces(7), voxels);
  EXPECT_EQ(faces(8), voxels / 4);
  EXPECT_EQ(faces(16), voxels / 16);
  EXPECT_EQ(faces(1000), voxels / 64);
  EXPECT_EQ(sizeOf(map, 16, true).faces, voxels);
  EXPECT_EQ(sizeOf(map, 6, true).samples, voxels); // 16 and less a triangle
  EXPECT_NEAR(sizeOf(map, 20, true).samples, voxels / (0.433 * 400 / 16), 1e-6);
}

TEST(StartingFaces, CountThoseOfACube)
{
  TissueMap map;
  map.grid.size = { 3, 3, 3 };
  map.labels.assign(27, 1);
  EXPECT_EQ(sizeOf(map, 1, true).startingFaces, 6 * 9);
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
