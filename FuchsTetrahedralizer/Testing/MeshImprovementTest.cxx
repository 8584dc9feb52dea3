// SPDX-License-Identifier: Apache-2.0
// Improvement where it is needed most: on the slivers of a constrained Delaunay tetrahedralization.

#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "Shapes.h"
#include "SurfaceTetrahedralization.h"
#include "TetrahedraImprovement.h"
#include "VoxelMesh.h"

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

/// Of the tissues, in degrees: the worst dihedral angle, 150 counting as 30.
double worstAngle(const TetMesh& mesh)
{
  double worst = 90;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    if (mesh.labels[t] == 0) continue;
    for (double angle : dihedralAngles(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]))
      worst = std::min({ worst, angle, 180 - angle });
  }
  return worst;
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

} // namespace surgicalmesher
