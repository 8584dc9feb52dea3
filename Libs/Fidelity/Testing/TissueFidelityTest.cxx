// SPDX-License-Identifier: Apache-2.0
// Both sides of a surface and its map: what one side sees, the other need not.
#include "TissueFidelity.h"

#include "FaceAdjacency.h"
#include "Shapes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <vtkSMPTools.h>

namespace surgicalmesher::test
{
namespace
{

/// A box of 10 x 10 x 8 voxels of 2 x 2 x 3 mm, one tissue's left and another's right half, and the voxels' own faces
/// as triangles.
TissueMap halves()
{
  return paintedMap({ 12, 12, 10 },
                    [](int i, int j, int k) {
                      return i < 1 || i > 10 || j < 1 || j > 10 || k < 1 || k > 8 ? 0 : i < 6 ? 3 : 7;
                    },
                    { 2, 2, 3 });
}

TEST(TissueFidelity, OfTheVoxelsOwnFacesIsExact)
{
  const TissueMap map = halves();
  const auto tissues = assessFidelity(interfaceOf(tetrahedraOf(map)), map);
  ASSERT_EQ(tissues.size(), 2u);
  for (const auto& [label, tissue] : tissues)
  {
    EXPECT_EQ(tissue.mapVolume, 5 * 10 * 8 * 12) << label;
    EXPECT_NEAR(tissue.meshVolume, tissue.mapVolume, 1e-9);
    EXPECT_EQ(tissue.mapToMesh.samples, 2u * (10 * 8 + 5 * 8 + 5 * 10));
    EXPECT_NEAR(tissue.mapToMesh.maximum, 0, 1e-9);
    EXPECT_NEAR(tissue.meshToMap.maximum, 0, 1e-9);
    EXPECT_GT(tissue.meshToMap.samples, 1000u);
  }
}

// B3 as the report sees it: a dent in a flat wall is far from every face of the map, while every face is near the
// surface.
TEST(Trial, B03_ADentIsSeenFromTheMesh)
{
  const TissueMap map = halves();
  SurfaceComplex surface = interfaceOf(tetrahedraOf(map));
  const Vec3 wall{ 3 * 2 - 1, 5 * 2 - 1, 1 * 3 - 1.5 };
  for (Vec3& p : surface.points)
  {
    if (norm(p - wall) < 1e-6) p.z += 2.5;
  }
  const auto tissues = assessFidelity(surface, map, 1.5);
  EXPECT_NEAR(tissues.at(3).meshToMap.maximum, 2.5, 1e-9);
  EXPECT_NEAR(tissues.at(3).meshToMap.farthest.z, wall.z + 2.5, 1e-9);
  EXPECT_LT(tissues.at(3).mapToMesh.maximum, 1.2);
  EXPECT_EQ(tissues.at(3).meshToMap.beyond, 1u);
  EXPECT_NEAR(tissues.at(7).meshToMap.maximum, 0, 1e-9);
  EXPECT_LT(tissues.at(3).meshVolume, tissues.at(3).mapVolume - 1);
  EXPECT_NEAR(allDistances(tissues, &TissueFidelity::meshToMap).maximum, 2.5, 1e-9);
}

TEST(TissueFidelity, DistancesAreThoseOfABruteForceSearch)
{
  const TissueMap map =
    paintedMap({ 17, 15, 16 },
               [](int i, int j, int k) {
                 return norm(Vec3{ double(i), double(j), double(k) } - Vec3{ 8, 7, 8 }) < 5.3 ? 1 : 0;
               });
  const SurfaceComplex surface = sphere({ 8.2, 7, 8 }, 5, 2);
  double worst = 0;
  std::size_t samples = 0;
  for (int k = -1; k < 16; ++k)
    for (int j = -1; j < 15; ++j)
      for (int i = -1; i < 17; ++i)
        for (int axis = 0; axis < 3; ++axis)
        {
          std::array<int, 3> voxel{ i, j, k }, next = voxel;
          ++next[axis];
          if (labelAt(map, voxel) == labelAt(map, next)) continue;
          Vec3 p{ double(i), double(j), double(k) };
          p[axis] += 0.5;
          double nearest = 1e9;
          for (int n = 0; n < 20000; ++n) // points on the triangles
          {
            const auto& [a, b, c] = surface.triangles[n % surface.triangles.size()];
            const double u = ((n * 7919) % 1000) / 1000.0, v = (1 - u) * ((n * 104729) % 1000) / 1000.0;
            const Vec3 q = surface.points[a] + u * (surface.points[b] - surface.points[a]) +
                           v * (surface.points[c] - surface.points[a]);
            nearest = std::min(nearest, norm(q - p));
          }
          worst = std::max(worst, nearest);
          ++samples;
        }
  const Distances found = assessFidelity(surface, map).at(1).mapToMesh;
  EXPECT_EQ(found.samples, samples);
  EXPECT_NEAR(found.maximum, worst, 0.1);
  EXPECT_LE(found.maximum, worst);
}

TEST(TissueFidelity, IsTheSameWhateverTheNumberOfThreads)
{
  const TissueMap map = halves();
  SurfaceComplex surface = interfaceOf(tetrahedraOf(map));
  for (std::size_t n = 0; n < surface.points.size(); ++n) surface.points[n].x += 0.001 * double(n % 97);
  vtkSMPTools::Initialize(1);
  const Distances one = assessFidelity(surface, map).at(3).mapToMesh;
  vtkSMPTools::Initialize(3);
  const Distances three = assessFidelity(surface, map).at(3).mapToMesh;
  EXPECT_EQ(one.mean, three.mean);
  EXPECT_EQ(one.maximum, three.maximum);
  EXPECT_TRUE(one.farthest == three.farthest);
}

TEST(TissueFidelity, OfATissueWithoutTrianglesIsInfinite)
{
  const TissueMap map = halves();
  const auto tissues = assessFidelity({}, map);
  EXPECT_TRUE(std::isinf(tissues.at(3).mapToMesh.maximum));
  EXPECT_EQ(tissues.at(3).meshVolume, 0);
}

} // namespace
} // namespace surgicalmesher::test
