// SPDX-License-Identifier: Apache-2.0
#include "Structures.h"

#include "VoxelMesh.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

TEST(Structures, AreNamedByTissueLargestFirst)
{
  TissueMap map = paintedMap({ 12, 5, 5 },
                             [](int i, int j, int k)
                             {
                               if (i == 1 && j == 1) return 4;            // five voxels
                               if (i >= 4 && i < 6 && k < 4) return 4;    // forty
                               return i == 8 && j == 2 && k == 2 ? 9 : 0; // one
                             },
                             { 1, 2, 0.5 });
  map.grid.origin = { 10, -20, 30 };
  map.table[4].name = "vessel";
  const std::vector<Structure> structures = structuresOf(map);
  ASSERT_EQ(structures.size(), 3u);
  EXPECT_EQ(structures[0].name, "vessel 1");
  EXPECT_EQ(structures[0].voxels, 40u);
  EXPECT_EQ(structures[0].centre, (Vec3{ 14.5, -16, 30.75 }));
  EXPECT_EQ(structures[1].name, "vessel 2");
  EXPECT_EQ(structures[1].voxels, 5u);
  EXPECT_EQ(structures[1].centre, (Vec3{ 11, -18, 31 }));
  EXPECT_EQ(structures[2].name, "tissue 9");
  EXPECT_EQ(structures[2].label, 9);
  EXPECT_EQ(structures[2].topology, (Betti{ 1, 0, 0 }));
}
