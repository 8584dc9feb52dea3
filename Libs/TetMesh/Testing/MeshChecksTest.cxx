// SPDX-License-Identifier: Apache-2.0
#include "MeshChecks.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "Shapes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <random>

namespace surgicalmesher
{

using test::paintedMap;
using test::tetrahedraOf;

/// A ball of label 1 around a core of label 2.
static TissueMap nestedBalls()
{
  return paintedMap({ 9, 9, 9 },
                    [](int i, int j, int k)
                    {
                      const int squared = (i - 4) * (i - 4) + (j - 4) * (j - 4) + (k - 4) * (k - 4);
                      return squared <= 3 ? 2 : squared <= 14 ? 1 : 0;
                    });
}

TEST(InterfaceOf, SeparatesLabelsOnceAndEnclosesTheirVolumes)
{
  const TetMesh mesh = tetrahedraOf(nestedBalls());
  std::vector<std::int32_t> pointIds;
  const SurfaceComplex surface = interfaceOf(mesh, &pointIds);
  const auto tissues = checkSurface(surface);
  ASSERT_EQ(tissues.size(), 2u);
  for (const auto& [label, tissue] : tissues)
  {
    EXPECT_TRUE(tissue.manifold()) << label;
    double volume = 0;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) volume += mesh.labels[t] == label ? 1.0 / 6 : 0;
    EXPECT_NEAR(tissue.volume, volume, 1e-9 * volume);
  }
  EXPECT_EQ(tissues.at(2).euler, 2);
  EXPECT_EQ(tissues.at(1).euler, 4) << "a shell has two boundary spheres";
  for (const auto& [behind, front] : surface.labels) EXPECT_GT(behind, front);
  ASSERT_EQ(pointIds.size(), surface.points.size());
  EXPECT_TRUE(std::is_sorted(pointIds.begin(), pointIds.end()));
  for (std::size_t i = 0; i < pointIds.size(); ++i) EXPECT_TRUE(mesh.points[pointIds[i]] == surface.points[i]);
}

TEST(InterfaceOf, IsTheSameWithoutTheOutsideTetrahedra)
{
  const TetMesh mesh = tetrahedraOf(nestedBalls());
  const SurfaceComplex ambient = interfaceOf(mesh), alone = interfaceOf(withoutOutside(mesh));
  EXPECT_EQ(ambient.triangles, alone.triangles);
  EXPECT_EQ(ambient.labels, alone.labels);
}

TEST(CheckSurface, CountsHandles)
{
  EXPECT_EQ(checkSurface(test::sphere({}, 1, 2)).at(1).euler, 2);
  EXPECT_EQ(checkSurface(test::torus(3, 1, 12, 8)).at(1).euler, 0);
}

TEST(CheckSurface, FindsAnOpenEdge)
{
  SurfaceComplex surface = test::sphere({ 10, 20, 30 }, 1, 1);
  surface.triangles.pop_back();
  surface.labels.pop_back();
  const TissueSurface tissue = checkSurface(surface).at(1);
  EXPECT_EQ(tissue.openEdges.count, 3u);
  EXPECT_FALSE(tissue.closed());
  EXPECT_LE(norm(tissue.openEdges.where - Vec3{ 10, 20, 30 }), 1.0);
}

TEST(CheckSurface, FindsATurnedTriangle)
{
  SurfaceComplex surface = test::sphere({}, 1, 1);
  std::swap(surface.triangles[5][0], surface.triangles[5][1]);
  const TissueSurface tissue = checkSurface(surface).at(1);
  EXPECT_EQ(tissue.openEdges.count, 0u);
  EXPECT_EQ(tissue.misorientedEdges.count, 3u);
}

TEST(CheckSurface, FindsATissueThatTouchesItself)
{
  const auto diagonal = [](bool apart, bool corner)
  {
    return paintedMap({ 2, 2, 2 }, [=](int i, int j, int k)
                      { return (i == j && (corner ? k == i : k == 0)) ? (apart && i == 1 ? 2 : 1) : 0; });
  };
  const auto edge = checkSurface(interfaceOf(tetrahedraOf(diagonal(false, false)))).at(1);
  EXPECT_EQ(edge.nonManifoldEdges.count, 1u);
  EXPECT_TRUE(edge.closed());
  const auto corner = checkSurface(interfaceOf(tetrahedraOf(diagonal(false, true)))).at(1);
  EXPECT_EQ(corner.nonManifoldEdges.count, 0u);
  EXPECT_EQ(corner.nonManifoldVertices.count, 1u);
  for (const auto& [label, tissue] : checkSurface(interfaceOf(tetrahedraOf(diagonal(true, false)))))
  {
    EXPECT_TRUE(tissue.manifold()) << "two tissues may touch along an edge";
  }
}

TEST(CheckMesh, FindsEachDefect)
{
  TetMesh mesh = withoutOutside(tetrahedraOf(nestedBalls()));
  EXPECT_TRUE(checkMesh(mesh).none());
  TetMesh inverted = mesh;
  std::swap(inverted.tetrahedra[7][0], inverted.tetrahedra[7][1]);
  EXPECT_EQ(checkMesh(inverted).invertedOrFlat.count, 1u);
  EXPECT_EQ(checkMesh(inverted).invertedOrFlat.item, 7);
  TetMesh unused = mesh;
  unused.points.push_back({ 100, 0, 0 });
  EXPECT_EQ(checkMesh(unused).unusedPoints.count, 1u);
  unused.points.back() = unused.points.front();
  EXPECT_EQ(checkMesh(unused).duplicatePoints.count, 1u);
  TetMesh overlapping = mesh;
  overlapping.tetrahedra.push_back(mesh.tetrahedra.front());
  overlapping.labels.push_back(mesh.labels.front());
  EXPECT_GE(checkMesh(overlapping).overusedFaces.count, 2u);
}

/// What requireSound() says in the stage of that name; empty if nothing.
std::string complaintOf(const TetMesh& mesh, const std::string& stage)
{
  try
  {
    requireSound(mesh, stage);
    return {};
  }
  catch (const EngineError& error)
  {
    return error.what();
  }
}

TEST(CheckMesh, RequireSoundNamesStageAndPlace)
{
  const TetMesh mesh = withoutOutside(tetrahedraOf(nestedBalls()));
  EXPECT_EQ(complaintOf(mesh, "test"), "");
  TetMesh inverted = mesh;
  std::swap(inverted.tetrahedra[7][0], inverted.tetrahedra[7][1]);
  const std::string complaint = complaintOf(inverted, "improvement");
  EXPECT_NE(complaint.find("improvement: 1 inverted or flat"), std::string::npos) << complaint;
  EXPECT_NE(complaint.find("mm"), std::string::npos) << complaint;
}

TEST(CheckMesh, RequireSoundTellsOfTetrahedraBeforeSurfaces)
{
  TetMesh mesh = withoutOutside(tetrahedraOf(nestedBalls()));
  const auto first = mesh.tetrahedra.front(); // by value: it may move
  mesh.tetrahedra.push_back(first);
  mesh.labels.push_back(mesh.labels.front());
  const std::string complaint = complaintOf(mesh, "test");
  EXPECT_NE(complaint.find("a face that more than two share"), std::string::npos) << complaint;
}

TEST(MeshTopology, KnowsSimpleShapes)
{
  const auto ring = [](int i, int j, int k)
  { return k == 1 && i > 0 && j > 0 && i < 4 && j < 4 && (i != 2 || j != 2); };
  const auto shell = [](int i, int j, int k) { return i == 2 && j == 2 && k == 2 ? 0 : 1; };
  const auto topology = [](const std::function<int(int, int, int)>& paint) {
    return meshTopology(tetrahedraOf(paintedMap({ 5, 5, 5 }, paint))).at(1);
  };
  EXPECT_TRUE(topology(ring) == (Betti{ 1, 1, 0 }));
  EXPECT_TRUE(topology(shell) == (Betti{ 1, 0, 1 }));
  EXPECT_TRUE(topology([](int i, int, int) { return i % 2; }) == (Betti{ 2, 0, 0 }));
}

/// The strongest statement about either: two independent countings agree on noise, where everything touches everything.
TEST(MeshTopology, EqualsTheMapsOnNoise)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial)
  {
    const TissueMap map = paintedMap({ 6, 5, 4 }, [&](int, int, int) { return random() % 4; });
    const auto expected = tissueTopology(map);
    for (const TetMesh& mesh : { tetrahedraOf(map), withoutOutside(tetrahedraOf(map)) })
    {
      const auto found = meshTopology(mesh);
      ASSERT_EQ(found.size(), expected.size());
      for (const auto& [label, betti] : expected)
      {
        EXPECT_EQ(found.at(label).components, betti.components) << trial << " " << label;
        EXPECT_EQ(found.at(label).tunnels, betti.tunnels) << trial << " " << label;
        EXPECT_EQ(found.at(label).cavities, betti.cavities) << trial << " " << label;
      }
    }
  }
}

} // namespace surgicalmesher
