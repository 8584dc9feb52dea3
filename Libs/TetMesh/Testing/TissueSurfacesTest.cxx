// SPDX-License-Identifier: Apache-2.0
#include "TissueSurfaces.h"

#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

TEST(TissueSurfaces, EachIsClosedAndHasTheTissueBehindIt)
{
  const TissueMap map = paintedMap({ 6, 4, 4 },
                                   [](int i, int j, int k)
                                   {
                                     if (i == 1 && j == 1 && k == 1) return 3;
                                     return i < 3 ? 1 : i < 5 ? 2 : 0;
                                   });
  SurfaceFile content;
  content.surface = interfaceOf(tetrahedraOf(map));
  content.targetEdgeLength.assign(content.surface.points.size(), 2);
  content.tissues[1].name = "bone";
  const auto expected = checkSurface(content.surface);
  const std::map<Label, SurfaceFile> parts = tissueSurfaces(content);
  ASSERT_EQ(parts.size(), 3u);
  for (const auto& [label, part] : parts)
  {
    EXPECT_EQ(part.surface.triangles.size(), expected.at(label).triangles);
    EXPECT_EQ(part.targetEdgeLength.size(), part.surface.points.size());
    for (const auto& sides : part.surface.labels) EXPECT_EQ(sides[0], label);
    const TissueSurface found = checkSurface(part.surface).at(label);
    EXPECT_TRUE(found.manifold());
    EXPECT_NEAR(found.volume, expected.at(label).volume, 1e-9);
  }
}

TEST(TissueSurfaces, IndexIsXMLWhateverTheNames)
{
  TissueTable tissues;
  tissues[1].name = "a < b & \"c\" > d";
  const std::string text = multiBlockIndex({ { 1, "x&y-1.vtp" }, { 7, "x&y-7.vtp" } }, tissues);
  EXPECT_NE(text.find("name=\"a &lt; b &amp; &quot;c&quot; &gt; d\" file=\"x&amp;y-1.vtp\""), std::string::npos);
  EXPECT_NE(text.find("index=\"1\" name=\"tissue 7\""), std::string::npos);
}
