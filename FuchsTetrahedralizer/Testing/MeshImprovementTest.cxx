// SPDX-License-Identifier: Apache-2.0
// Improvement where it is needed most: on the slivers of a constrained Delaunay tetrahedralization.

#include "EdgeDivision.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "Shapes.h"
#include "SurfaceTetrahedralization.h"
#include "TetrahedraImprovement.h"
#include "VoxelMesh.h"
#include "WorstAngle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surgicalmesher
{
namespace
{

using namespace test;

struct Shape
{
  std::string name;
  SurfaceComplex surface;
  double edgeLength;
};

std::vector<Shape> shapes()
{
  SurfaceComplex nested = sphere({}, 8, 3, 1, 0);
  append(nested, sphere({ 1, 0, 0 }, 4, 2, 2, 1));
  const TissueMap junction = paintedMap({ 6, 6, 4 }, [](int i, int j, int) { return i < 3 ? 1 : j < 3 ? 2 : 3; });
  return { { "sphere", sphere({ 3, 4, 5 }, 10, 3), 2 },
           { "torus", torus(8, 3, 32, 12), 1.5 },
           { "nested spheres", nested, 1.5 },
           { "three tissues around a curve", interfaceOf(tetrahedraOf(junction)), 1.2 } };
}

} // namespace

TEST(MeshImprovement, RaisesTheWorstAngleOfADelaunayMeshAndKeepsItsTissues)
{
  for (const Shape& shape : shapes())
  {
    SCOPED_TRACE(shape.name);
    const auto edgeLength = [&](const Vec3&) { return shape.edgeLength; };
    const TetMesh before = fillWithTetrahedra(shape.surface, edgeLength, shape.name);
    const auto volumes = checkSurface(interfaceOf(before));
    for (double tolerance : { 0.02, 0.12 })
    {
      TetMesh after = before;
      TetrahedraImprovementOptions options;
      options.surfaceTolerance = tolerance;
      improveTetrahedra(
        after, [&](const Vec3&) { return float(shape.edgeLength); }, options);
      requireSound(after, "improvement");
      EXPECT_EQ(meshTopology(after), meshTopology(before));
      EXPECT_GT(worstAngle(after), worstAngle(before));
      EXPECT_GT(worstAngle(after), 10);
      const SurfaceComplex surface = interfaceOf(after);
      for (const auto& [label, tissue] : checkSurface(surface))
      {
        // The surface lies within the tolerance everywhere, so the volume within that times its area.
        double area = 0;
        for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        {
          const auto& [a, b, c] = surface.triangles[t];
          const auto& p = surface.points;
          if (surface.labels[t][0] == label || surface.labels[t][1] == label)
            area += 0.5 * norm(cross(p[b] - p[a], p[c] - p[a]));
        }
        EXPECT_NEAR(tissue.volume, volumes.at(label).volume, area * tolerance * shape.edgeLength) << "label " << label;
      }
    }
  }
}

// B4: its faces bulged, and its edges became round.
TEST(Trial, B04_ACubeOfTwelveTrianglesStaysACube)
{
  SurfaceComplex cube;
  for (int n = 0; n < 8; ++n) cube.points.push_back({ n & 1 ? 10. : -10., n & 2 ? 10. : -10., n & 4 ? 10. : -10. });
  cube.triangles = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
                     { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  cube.labels.assign(12, { 1, 0 });
  for (const double length : { 2., 3., 5. })
  {
    const auto edgeLength = [&](const Vec3&) { return length; };
    TetMesh mesh = fillWithTetrahedra(withDividedEdges(cube, edgeLength), edgeLength, "cube");
    TetrahedraImprovementOptions options;
    options.featureAngle = 40;
    improveTetrahedra(mesh, edgeLength, options);
    EXPECT_GT(worstAngle(mesh), 20) << length;
    const SurfaceComplex surface = interfaceOf(mesh);
    EXPECT_NEAR(checkSurface(surface).at(1).volume, 8000, 1e-6) << length;
    for (const auto& ids : surface.triangles)
      for (const std::int32_t id : ids)
      {
        const Vec3& p = surface.points[id];
        EXPECT_NEAR(std::max({ std::abs(p.x), std::abs(p.y), std::abs(p.z) }), 10, 1e-9) << length;
      }
  }
}

} // namespace surgicalmesher
