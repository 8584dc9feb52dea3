// SPDX-License-Identifier: Apache-2.0
#include "SubMeshes.h"
#include "FaceAdjacency.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace surgicalmesher
{
namespace
{

TetMesh block(
  const std::array<int, 3>& size, const std::function<int(int, int, int)>& paint = [](int, int, int) { return 1; })
{
  return withoutOutside(test::tetrahedraOf(test::paintedMap(size, paint)));
}

/// 1 mm within `radius` of one of the centres, 4 mm elsewhere.
SizingFunction fineAround(const std::vector<Vec3>& centres, double radius)
{
  return [=](const Vec3& p)
  {
    return std::any_of(centres.begin(), centres.end(), [&](const Vec3& c) { return norm(p - c) < radius; }) ? 1.0 : 4.0;
  };
}

std::size_t piecesOf(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh, std::int32_t id)
{
  const FaceAdjacency neighbours = faceAdjacency(mesh);
  const auto region =
    faceRegions(neighbours, [&](std::int32_t t, int f) { return subMesh[t] == subMesh[neighbours.across[t][f]]; });
  std::set<std::int32_t> pieces;
  for (std::size_t t = 0; t < region.size(); ++t)
  {
    if (subMesh[t] == id) pieces.insert(region[t]);
  }
  return pieces.size();
}

TEST(SubMeshes, OneChildPerFineRegionLargestFirst)
{
  const TetMesh mesh = block({ 20, 8, 8 });
  const SizingFunction length = [](const Vec3& p) {
    return fineAround({ { 4, 4, 4 } }, 2.5)(p) < 4 || fineAround({ { 15, 4, 4 } }, 3.5)(p) < 4 ? 1.0 : 4.0;
  };
  const SubMeshes division = divideIntoSubMeshes(mesh, length);
  ASSERT_EQ(division.children, 2);
  EXPECT_EQ(division.pieces, (std::vector<std::int32_t>{ 1, 1, 1 }));
  for (std::int32_t id = 0; id <= 2; ++id) EXPECT_EQ(piecesOf(mesh, division.ofTetrahedron, id), 1u) << id;
  const auto count = [&](std::int32_t id)
  { return std::count(division.ofTetrahedron.begin(), division.ofTetrahedron.end(), id); };
  EXPECT_GT(count(1), count(2));
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    const Vec3 centre = 0.25 * (mesh.points[a] + mesh.points[b] + mesh.points[c] + mesh.points[d]);
    EXPECT_EQ(division.ofTetrahedron[t] > 0, length(centre) == 1.0);
  }
}

TEST(SubMeshes, InterfacePointsAreThoseOfBothSides)
{
  const TetMesh mesh = block({ 8, 8, 8 });
  const SubMeshes division = divideIntoSubMeshes(mesh, fineAround({ { 3.5, 3.5, 3.5 } }, 2.6));
  std::vector<std::set<std::int32_t>> around(mesh.points.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (const std::int32_t id : mesh.tetrahedra[t]) around[id].insert(division.ofTetrahedron[t]);
  }
  std::vector<std::int32_t> expected;
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    if (around[i].size() > 1) expected.push_back(static_cast<std::int32_t>(i));
  }
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(division.interfacePoints, expected);
}

TEST(SubMeshes, SpecksJoinTheParent)
{
  const TetMesh mesh = block({ 20, 8, 8 });
  const SizingFunction length = [](const Vec3& p) {
    return fineAround({ { 4, 4, 4 } }, 3.5)(p) < 4 || fineAround({ { 15, 4, 4 } }, 0.4)(p) < 4 ? 1.0 : 4.0;
  };
  EXPECT_EQ(divideIntoSubMeshes(mesh, length, { 0.25, 0 }).children, 2) << "there is a speck";
  const SubMeshes division = divideIntoSubMeshes(mesh, length);
  EXPECT_EQ(division.children, 1);
  EXPECT_EQ(division.pieces, (std::vector<std::int32_t>{ 1, 1 }));
}

TEST(SubMeshes, ScrapsOfTheParentJoinTheChildThatCutsThemOff)
{
  const TetMesh mesh = block({ 12, 8, 8 });
  const SizingFunction length = [](const Vec3& p)
  { return p.x < 4 && p.x > 0.5 ? 1.0 : 4.0; }; // a thin plate is cut off at x < 0.5
  const SubMeshes division = divideIntoSubMeshes(mesh, length);
  EXPECT_EQ(division.pieces, (std::vector<std::int32_t>{ 1, 1 }));
}

TEST(SubMeshes, UniformScaleHasNoChild)
{
  const TetMesh mesh = block({ 3, 3, 3 });
  const SubMeshes division = divideIntoSubMeshes(mesh, [](const Vec3&) { return 2.0; });
  EXPECT_EQ(division.children, 0);
  EXPECT_TRUE(division.interfacePoints.empty());
  EXPECT_EQ(divideIntoSubMeshes({}, [](const Vec3&) { return 2.0; }).children, 0);
}

TEST(SubMeshes, SeparateBodiesKeepTheirParents)
{
  const TetMesh mesh = block({ 9, 4, 4 }, [](int i, int, int) { return i == 4 ? 0 : i < 4 ? 1 : 2; });
  const SubMeshes division = divideIntoSubMeshes(mesh, fineAround({ { 1, 1, 1 } }, 1.6));
  EXPECT_EQ(division.pieces, (std::vector<std::int32_t>{ 2, 1 })) << "the parent is in two bodies";
}

// B1: tissues were recognised by their names, which an atlas's table may change.
TEST(Trial, B01_constitutiveModelsFollowSubMeshAndRoleNotName)
{
  const TetMesh mesh = block({ 4, 1, 1 }, [](int i, int, int) { return 1 + i / 2; });
  std::vector<std::int32_t> subMesh(mesh.tetrahedra.size(), 0);
  subMesh[0] = 2;
  TissueTable tissues{ { 2, { "Frontal Mid Orb L", {} } }, { 1, { "null displacement", {} } } };
  tissues[2].isNullDisplacement = true;
  const auto models = constitutiveModels(mesh, subMesh, tissues);
  for (std::size_t t = 0; t < models.size(); ++t) EXPECT_EQ(models[t], mesh.labels[t] == 2 ? 2 : t == 0 ? 1 : 0);
}

} // namespace
} // namespace surgicalmesher
