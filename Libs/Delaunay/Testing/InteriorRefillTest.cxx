// SPDX-License-Identifier: Apache-2.0
#include "InteriorRefill.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "Shapes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <vtkSMPTools.h>

#include <algorithm>
#include <set>

namespace surgicalmesher
{
namespace
{

using namespace test;

using Corners = std::array<std::tuple<double, double, double>, 3>;

/// The triangles between labels by their places, in ascending order.
std::vector<std::pair<Corners, std::array<Label, 2>>> placedInterface(const TetMesh& mesh)
{
  const SurfaceComplex surface = interfaceOf(mesh);
  std::vector<std::pair<Corners, std::array<Label, 2>>> result;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    Corners corners;
    for (int c = 0; c < 3; ++c)
    {
      const Vec3& p = surface.points[surface.triangles[t][c]];
      corners[c] = { p.x, p.y, p.z };
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.emplace_back(corners, surface.labels[t]);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// A deep tissue 1 with a hollow of background, and on one face of it a tissue 2 of one layer of voxels.
TetMesh deepAndThin()
{
  const auto label = [](int i, int j, int k)
  {
    const bool inHollow = std::max({ std::abs(i - 7), std::abs(j - 7), std::abs(k - 6) }) <= 1;
    const bool atRim = std::min({ i, j, k }) == 0 || std::max({ i, j, k }) == 14;
    if (atRim || inHollow) return 0;
    return k == 13 ? 2 : 1;
  };
  return tetrahedraOf(paintedMap({ 15, 15, 15 }, label));
}

std::size_t countOf(const TetMesh& mesh, Label label)
{
  return std::size_t(std::count(mesh.labels.begin(), mesh.labels.end(), label));
}

double somewhatMoreThanAVoxel(const Vec3&) { return 1.3; }

TetMesh laidAnew(const TetMesh& before)
{
  return withLatticeInside(before, tissuesWithRoom(before, somewhatMoreThanAVoxel), somewhatMoreThanAVoxel, "shape");
}

} // namespace

TEST(LatticeInside, KeepsEveryTriangleBetweenLabelsAndEveryTissue)
{
  const TetMesh before = deepAndThin();
  const TetMesh after = laidAnew(before);
  requireSound(after, "refill");
  EXPECT_EQ(placedInterface(after), placedInterface(before));
  EXPECT_EQ(meshTopology(after), meshTopology(before));
}

TEST(LatticeInside, LaysAnewOnlyWhatHasRoom)
{
  const TetMesh before = deepAndThin();
  const TetMesh after = laidAnew(before);
  EXPECT_LT(countOf(after, 1), countOf(before, 1)) << "L is longer than a voxel";
  EXPECT_EQ(countOf(after, 2), countOf(before, 2)) << "one layer has none";
  EXPECT_EQ(countOf(after, 0), countOf(before, 0)) << "the space outside is no tissue";
  EXPECT_EQ(withLatticeInside(before, {}, somewhatMoreThanAVoxel, "shape").tetrahedra, before.tetrahedra);
  const TetMesh thin = withLatticeInside(before, { 2 }, somewhatMoreThanAVoxel, "shape");
  EXPECT_NE(thin.tetrahedra, before.tetrahedra);
  EXPECT_EQ(countOf(thin, 1), countOf(before, 1)) << "nobody has asked for it";
}

TEST(LatticeInside, HasRoomWhereATissueIsDeepAndItsEdgesAreAsLongAsAskedFor)
{
  const TetMesh mesh = deepAndThin();
  EXPECT_EQ(tissuesWithRoom(mesh, somewhatMoreThanAVoxel), std::set<Label>{ 1 });
  EXPECT_TRUE(tissuesWithRoom(mesh, [](const Vec3&) { return 2.5; }).empty())
    << "edges of a voxel ask for more than L does";
}

TEST(LatticeInside, DoesNotDependOnThreads)
{
  const TetMesh before = deepAndThin();
  vtkSMPTools::Initialize(1);
  const TetMesh one = laidAnew(before);
  vtkSMPTools::Initialize(3);
  const TetMesh three = laidAnew(before);
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(one.tetrahedra, three.tetrahedra);
  ASSERT_EQ(one.points.size(), three.points.size());
  EXPECT_TRUE(std::equal(one.points.begin(), one.points.end(), three.points.begin()));
}

} // namespace surgicalmesher
