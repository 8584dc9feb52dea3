// SPDX-License-Identifier: Apache-2.0
#include "SimplexMesh.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "RandomMaps.h"
#include "Shapes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <set>

namespace surgicalmesher
{
using namespace test;
namespace
{

SurfaceComplex surfaceOf(const TissueMap& map) { return interfaceOf(tetrahedraOf(map)); }

/// Two boxes side by side, a third on both: junction curves and points, and triangles between every two labels.
TissueMap threeBoxes()
{
  return paintedMap({ 6, 6, 6 },
                    [](int i, int j, int k) {
                      return i < 1 || j < 1 || k < 1 || i > 4 || j > 4 || k > 4 ? 0 : k > 2 ? 3 : i > 2 ? 2 : 1;
                    });
}

void expectThreeNeighboursOnEachSurface(const SimplexMesh& mesh)
{
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (int side = 0; side < 2; ++side)
    {
      const Label tissue = mesh.labels[v][side];
      const auto& three = mesh.neighbours[v][side];
      if (tissue == 0 && three[0] < 0) continue; // pinched outside
      for (int k = 0; k < 3; ++k)
      {
        const auto& labels = mesh.labels[three[k]];
        const int back = labels[0] == tissue ? 0 : 1;
        EXPECT_EQ(labels[back], tissue);
        const auto& its = mesh.neighbours[three[k]][back];
        EXPECT_EQ(std::count(its.begin(), its.end(), std::int32_t(v)), 1) << "being neighbours is mutual";
      }
      EXPECT_EQ(std::set<std::int32_t>(three.begin(), three.end()).size(), 3u);
    }
}

} // namespace

TEST(SimplexMesh, EveryVertexHasThreeNeighboursOnEachTissuesSurface)
{
  expectThreeNeighboursOnEachSurface(simplexMeshOf(sphere({}, 1, 2)));
  expectThreeNeighboursOnEachSurface(simplexMeshOf(surfaceOf(threeBoxes())));
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    std::mt19937 random(seed);
    expectThreeNeighboursOnEachSurface(simplexMeshOf(surfaceOf(randomWellComposedMap(random, { 7, 6, 8 }, 4))));
  }
}

TEST(SimplexMesh, VerticesBesideAJunctionHaveOtherNeighboursOnEachSurface)
{
  const SimplexMesh mesh = simplexMeshOf(surfaceOf(threeBoxes()));
  int same = 0, other = 0;
  for (const auto& sides : mesh.neighbours) ++(sides[0] == sides[1] ? same : other);
  EXPECT_GT(same, 0);
  EXPECT_GT(other, 0);
}

TEST(SimplexMesh, WhereAPartEndsVerticesHaveNoNeighbours)
{
  SurfaceComplex surface = sphere({}, 1, 2);
  const std::array<std::int32_t, 3> gone = surface.triangles.back();
  surface.triangles.pop_back();
  surface.labels.pop_back();
  EXPECT_THROW(simplexMeshOf(surface), InputError);
  const SimplexMesh mesh = simplexMeshOf(surface, Extent::part);
  int without = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
  {
    const auto isThere = [&](std::int32_t p) { return std::count(gone.begin(), gone.end(), p) > 0; };
    const bool isBeside = std::count_if(mesh.faces[v].begin(), mesh.faces[v].end(), isThere) == 2;
    EXPECT_EQ(mesh.neighbours[v][0][0] < 0, isBeside);
    without += isBeside;
  }
  EXPECT_EQ(without, 3);
  const SurfaceComplex boxes = surfaceOf(threeBoxes());
  EXPECT_EQ(simplexMeshOf(boxes, Extent::part).neighbours, simplexMeshOf(boxes).neighbours);
}

TEST(SimplexMesh, DualTrianglesAreConnectedAsBefore)
{
  const SurfaceComplex surface = surfaceOf(threeBoxes());
  const SurfaceComplex back = dualTriangles(simplexMeshOf(surface));
  EXPECT_EQ(back.triangles, surface.triangles);
  EXPECT_EQ(back.labels, surface.labels);
  EXPECT_EQ(back.points.size(), surface.points.size());
}

TEST(SimplexMesh, DualTrianglesHaveTheirVerticesAsCentroids)
{
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 0.02);
  for (SurfaceComplex surface : { torus(5, 2, 17, 11), sphere({ 1, 2, 3 }, 4, 2) })
  {
    for (Vec3& p : surface.points) p += Vec3{ noise(random), noise(random), noise(random) };
    const SimplexMesh mesh = simplexMeshOf(surface);
    const SimplexMesh again = simplexMeshOf(dualTriangles(mesh));
    double worst = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      worst = std::max(worst, norm(again.points[v] - mesh.points[v]));
    EXPECT_LT(worst, 0.05);
  }
}

TEST(SimplexMesh, VerticesOnASphereGiveTrianglesThatTouchIt)
{
  const double radius = 3;
  SimplexMesh mesh = simplexMeshOf(sphere({}, radius, 3));
  for (Vec3& p : mesh.points) p = radius / norm(p) * p;
  const double volume = checkSurface(dualTriangles(mesh)).at(1).volume;
  const double exact = 4. / 3 * std::acos(-1.) * radius * radius * radius;
  EXPECT_NEAR(volume / exact, 1, 0.01);
}

TEST(SimplexMesh, FacesOfATissueAreAClosedSurfaceOfItsTopology)
{
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    std::mt19937 random(seed);
    const SurfaceComplex surface = surfaceOf(randomWellComposedMap(random, { 7, 6, 8 }, 3));
    const SimplexMesh mesh = simplexMeshOf(surface);
    std::map<Label, std::map<std::pair<std::int32_t, std::int32_t>, int>> edges;
    std::map<Label, std::set<std::int32_t>> vertices;
    std::map<Label, int> faceCount;
    for (const SimplexFace& face : simplexFaces(mesh))
    {
      ++faceCount[face.tissue];
      for (std::size_t i = 0; i < face.vertices.size(); ++i)
      {
        ++edges[face.tissue][{ face.vertices[i], face.vertices[(i + 1) % face.vertices.size()] }];
        vertices[face.tissue].insert(face.vertices[i]);
      }
    }
    const auto tissues = checkSurface(surface);
    EXPECT_EQ(faceCount.size(), tissues.size());
    for (const auto& [label, tissue] : tissues)
    {
      for (const auto& [edge, count] : edges[label])
      {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges[label].count({ edge.second, edge.first }), 1u) << "the next face has it the other way round";
      }
      EXPECT_EQ(vertices[label].size(), tissue.triangles);
      EXPECT_EQ(int(vertices[label].size()) - int(edges[label].size()) / 2 + faceCount[label], tissue.euler);
    }
  }
}

TEST(SimplexMesh, FacesAreSeenCounterClockwiseFromOutside)
{
  const SurfaceComplex ball = sphere({}, 2, 1, 5, 9);
  for (const SimplexFace& face : simplexFaces(simplexMeshOf(ball)))
  {
    const SimplexMesh mesh = simplexMeshOf(ball);
    Vec3 centre, area;
    for (std::int32_t v : face.vertices) centre += mesh.points[v] / double(face.vertices.size());
    for (std::size_t i = 0; i < face.vertices.size(); ++i)
      area += cross(mesh.points[face.vertices[i]] - centre,
                    mesh.points[face.vertices[(i + 1) % face.vertices.size()]] - centre);
    EXPECT_EQ(dot(area, centre) > 0, face.tissue == 5) << "the outside of tissue 9 is within the sphere";
  }
}

TEST(SimplexMesh, RefusesASurfaceThatIsOpen)
{
  SurfaceComplex surface = sphere({}, 1, 1);
  surface.triangles.pop_back();
  surface.labels.pop_back();
  EXPECT_THROW(simplexMeshOf(surface), InputError);
}

} // namespace surgicalmesher
