// SPDX-License-Identifier: Apache-2.0
#include "SubMeshExport.h"
#include "FaceAdjacency.h"
#include "SubMeshes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surgicalmesher
{
namespace
{

/// A block of two tissues with two fine regions, which becomes a parent and two children.
MeshFile dividedBlock()
{
  MeshFile whole;
  whole.mesh =
    withoutOutside(test::tetrahedraOf(test::paintedMap({ 16, 6, 6 }, [](int, int j, int) { return 1 + j / 3; })));
  const SizingFunction length = [](const Vec3& p) {
    return std::min(norm(p - Vec3{ 3, 3, 3 }), norm(p - Vec3{ 12, 3, 3 })) < 2.5 ? 1.0 : 4.0;
  };
  const SubMeshes division = divideIntoSubMeshes(whole.mesh, length);
  whole.subMesh = division.ofTetrahedron;
  whole.constitutive = constitutiveModels(whole.mesh, whole.subMesh, {});
  whole.subMeshInterface.assign(whole.mesh.points.size(), 0);
  for (const std::int32_t id : division.interfacePoints) whole.subMeshInterface[id] = 1;
  for (const Vec3& p : whole.mesh.points) whole.targetEdgeLength.push_back(length(p));
  whole.tissues[2].name = "bone";
  return whole;
}

/// The parts of the block by sub-mesh: parent, child 1, child 2.
std::vector<MeshFile> partsOf(const MeshFile& whole)
{
  std::vector<MeshFile> parts;
  for (std::int32_t k = 0; k < 3; ++k)
    parts.push_back(partOf(whole, [k](std::int32_t subMesh) { return subMesh == k; }));
  return parts;
}

TEST(SubMeshExport, PartsTogetherAreTheWholeMesh)
{
  const MeshFile whole = dividedBlock();
  std::vector<std::size_t> next(3, 0); // tetrahedron of each part that comes next in the whole mesh
  const std::vector<MeshFile> parts = partsOf(whole);
  for (std::size_t t = 0; t < whole.mesh.tetrahedra.size(); ++t)
  {
    const std::int32_t k = whole.subMesh[t];
    const MeshFile& part = parts[k];
    const std::size_t i = next[k]++;
    ASSERT_LT(i, part.mesh.tetrahedra.size());
    std::array<std::int32_t, 4> corners = part.mesh.tetrahedra[i];
    for (std::int32_t& id : corners) id = part.volumePointId[id];
    EXPECT_EQ(corners, whole.mesh.tetrahedra[t]);
    EXPECT_EQ(part.mesh.labels[i], whole.mesh.labels[t]);
    EXPECT_EQ(part.constitutive[i], whole.constitutive[t]);
    EXPECT_EQ(part.subMesh[i], k);
  }
  for (int k = 0; k < 3; ++k) EXPECT_EQ(next[k], parts[k].mesh.tetrahedra.size());
}

TEST(SubMeshExport, PointsAreThoseOfTheWholeMeshAndAllUsed)
{
  const MeshFile whole = dividedBlock();
  for (const MeshFile& part : partsOf(whole))
  {
    std::vector<bool> used(part.mesh.points.size(), false);
    for (const auto& tetrahedron : part.mesh.tetrahedra)
    {
      for (const std::int32_t id : tetrahedron) used[id] = true;
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    EXPECT_TRUE(std::is_sorted(part.volumePointId.begin(), part.volumePointId.end()));
    for (std::size_t i = 0; i < part.mesh.points.size(); ++i)
    {
      EXPECT_EQ(part.mesh.points[i], whole.mesh.points[part.volumePointId[i]]);
      EXPECT_EQ(part.targetEdgeLength[i], whole.targetEdgeLength[part.volumePointId[i]]);
    }
    EXPECT_EQ(part.tissues.at(2).name, "bone");
  }
}

TEST(SubMeshExport, InterfaceNumbersAreSharedAndComplete)
{
  const MeshFile whole = dividedBlock();
  std::vector<std::vector<std::int32_t>> sharers(whole.mesh.points.size()); // interface ids, one per part
  for (const MeshFile& part : partsOf(whole))
  {
    for (std::size_t i = 0; i < part.interfaceId.size(); ++i)
    {
      sharers[part.volumePointId[i]].push_back(part.interfaceId[i]);
    }
  }
  std::int32_t next = 0;
  for (const auto& ids : sharers)
  {
    ASSERT_FALSE(ids.empty());
    if (ids.size() == 1) EXPECT_EQ(ids[0], -1) << "a point of one part is on no interface";
    else
    {
      for (const std::int32_t id : ids) EXPECT_EQ(id, next);
      ++next;
    }
  }
  EXPECT_GT(next, 0);
}

TEST(SubMeshExport, ChildrenMayStayTogether)
{
  const MeshFile whole = dividedBlock();
  const MeshFile children = partOf(whole, [](std::int32_t subMesh) { return subMesh > 0; });
  const std::vector<MeshFile> parts = partsOf(whole);
  EXPECT_EQ(children.mesh.tetrahedra.size(), parts[1].mesh.tetrahedra.size() + parts[2].mesh.tetrahedra.size());
  EXPECT_NE(std::count(children.subMesh.begin(), children.subMesh.end(), 2), 0);
}

TEST(SubMeshExport, WholeMeshIsAPartOfItself)
{
  MeshFile whole = dividedBlock();
  const MeshFile all = partOf(whole, [](std::int32_t) { return true; });
  EXPECT_EQ(all.mesh.tetrahedra, whole.mesh.tetrahedra);
  EXPECT_EQ(all.subMeshInterface, whole.subMeshInterface);
  const MeshFile none = partOf(whole, [](std::int32_t) { return false; });
  EXPECT_TRUE(none.mesh.points.empty());
}

} // namespace
} // namespace surgicalmesher
