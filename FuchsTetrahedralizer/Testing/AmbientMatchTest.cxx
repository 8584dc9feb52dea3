// SPDX-License-Identifier: Apache-2.0
#include "AmbientMatch.h"
#include "FaceAdjacency.h"
#include "Shapes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surgicalmesher
{
namespace
{

TEST(IsInterfaceOf, HoldsForTheBackgroundsOwnSurfaceOnly)
{
  const TetMesh ambient = test::tetrahedraOf(test::paintedMap({ 4, 3, 3 }, [](int i, int, int) { return i % 3; }));
  SurfaceComplex surface = interfaceOf(ambient);
  EXPECT_TRUE(isInterfaceOf(surface, ambient));
  SurfaceComplex renumbered = surface;
  std::reverse(renumbered.triangles.begin(), renumbered.triangles.end());
  std::reverse(renumbered.labels.begin(), renumbered.labels.end());
  for (std::size_t t = 0; t < renumbered.triangles.size(); ++t)
  {
    std::swap(renumbered.triangles[t][0], renumbered.triangles[t][1]);
    std::swap(renumbered.labels[t][0], renumbered.labels[t][1]);
  }
  EXPECT_TRUE(isInterfaceOf(renumbered, ambient)) << "the same, told differently";

  SurfaceComplex moved = surface, relabelled = surface, missing = surface, unlabelled = surface;
  moved.points[5].x += 1e-9;
  relabelled.labels[3] = { 7, 0 };
  missing.triangles.pop_back();
  missing.labels.pop_back();
  unlabelled.labels.clear();
  for (const SurfaceComplex& other : { moved, relabelled, missing, unlabelled })
    EXPECT_FALSE(isInterfaceOf(other, ambient));
}

} // namespace
} // namespace surgicalmesher
