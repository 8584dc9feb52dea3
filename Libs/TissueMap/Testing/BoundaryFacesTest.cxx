// SPDX-License-Identifier: Apache-2.0
#include "BoundaryFaces.h"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

using namespace surgicalmesher;

namespace
{

/// One label, with a few voxels of others.
TissueMap mostlyUniform(const std::array<int, 3>& size, unsigned seed)
{
  TissueMap map;
  map.grid.size = size;
  std::mt19937 random(seed);
  map.labels.assign(map.grid.voxelCount(), Label(random() % 2));
  for (std::size_t n = 0; n < map.labels.size() / 20 + 1; ++n)
    map.labels[random() % map.labels.size()] = Label(random() % 4);
  return map;
}

using Faces = std::vector<std::tuple<int, int, int, int>>; // k, j, i, axis

Faces walked(const TissueMap& map)
{
  Faces faces;
  for (int k = -1; k < map.grid.size[2]; ++k)
    forEachBoundaryFace(map, k,
                        [&](const VoxelFace& face)
                        { faces.emplace_back(face.lower[2], face.lower[1], face.lower[0], face.axis); });
  return faces;
}

Faces expected(const TissueMap& map)
{
  Faces faces;
  for (int k = -1; k < map.grid.size[2]; ++k)
    for (int j = -1; j < map.grid.size[1]; ++j)
      for (int i = -1; i < map.grid.size[0]; ++i)
        for (int axis = 0; axis < 3; ++axis)
          if (const VoxelFace face{ { i, j, k }, axis }; labelAt(map, face.lower) != labelAt(map, face.upper()))
            faces.emplace_back(k, j, i, axis);
  return faces;
}

TEST(BoundaryFaces, AreThoseBetweenLabelsInOrder)
{
  const std::array<int, 3> sizes[] = {
    { 1, 1, 1 }, { 2, 3, 1 }, { 32, 4, 3 }, { 33, 3, 4 }, { 34, 2, 2 }, { 100, 7, 5 }
  };
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const auto& size : sizes)
    {
      const TissueMap map = mostlyUniform(size, seed);
      EXPECT_EQ(walked(map), expected(map)) << size[0] << ' ' << seed;
    }
}

TEST(BoundaryVoxels, AreThoseBesideAnotherLabelInOrder)
{
  const std::array<int, 3> sizes[] = { { 3, 3, 3 }, { 6, 4, 3 }, { 34, 5, 4 }, { 35, 3, 3 }, { 100, 7, 5 } };
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const auto& size : sizes)
    {
      const TissueMap map = mostlyUniform(size, seed);
      std::vector<std::size_t> walked, expected;
      for (int k = 1; k + 1 < size[2]; ++k)
        for (int j = 1; j + 1 < size[1]; ++j)
        {
          forEachBoundaryVoxel(map, j, k, 1, size[0] - 1, [&](std::size_t v) { walked.push_back(v); });
          for (int i = 1; i + 1 < size[0]; ++i)
          {
            const auto differs = [&](int di, int dj, int dk) {
              return labelAt(map, { i + di, j + dj, k + dk }) != labelAt(map, { i, j, k });
            };
            if (differs(-1, 0, 0) || differs(1, 0, 0) || differs(0, -1, 0) || differs(0, 1, 0) || differs(0, 0, -1) ||
                differs(0, 0, 1))
              expected.push_back(map.grid.index(i, j, k));
          }
        }
      EXPECT_EQ(walked, expected) << size[0] << ' ' << seed;
    }
}

TEST(BoundaryFaces, HaveAVoxelInsideTheMap)
{
  const TissueMap map = mostlyUniform({ 5, 4, 3 }, 1);
  for (int k = -1; k < 3; ++k)
    forEachBoundaryFace(map, k,
                        [&](const VoxelFace& face)
                        {
                          const auto voxel = voxelInside(map.grid, face);
                          EXPECT_TRUE(isInside(map.grid, voxel));
                          EXPECT_TRUE(voxel == face.lower || voxel == face.upper());
                        });
}

TEST(CountVoxels, CountsAllPartsOfALargeMap)
{
  const TissueMap map = mostlyUniform({ 200, 150, 101 }, 3); // several parts, not of equal size
  std::map<Label, std::size_t> counts;
  for (const Label label : map.labels) ++counts[label];
  EXPECT_EQ(countVoxels(map), counts);
}

} // namespace
