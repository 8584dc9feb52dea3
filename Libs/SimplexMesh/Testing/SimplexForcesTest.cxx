// SPDX-License-Identifier: Apache-2.0
#include "SimplexForces.h"
#include "MeshChecks.h"
#include "Shapes.h"
#include "SimplexGeometry.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <random>

namespace surgicalmesher
{
using namespace test;
namespace
{

/// Vertices on a sphere, spread unevenly.
SimplexMesh unevenSphere(double radius, int levels, Label inside = 1, Label outside = 0)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.1 * radius / (1 << levels));
  SurfaceComplex surface = sphere({}, radius, levels, inside, outside);
  for (Vec3& p : surface.points) p += Vec3{ noise(random), noise(random), noise(random) };
  SimplexMesh mesh = simplexMeshOf(surface);
  for (Vec3& p : mesh.points) p = radius / norm(p) * p;
  return mesh;
}

double largest(const std::vector<Vec3>& vectors)
{
  double most = 0;
  for (const Vec3& v : vectors) most = std::max(most, norm(v));
  return most;
}

InternalForceOptions keepingMetric(const SimplexShape& shape, Continuity continuity)
{
  InternalForceOptions options;
  options.continuity = continuity;
  options.metric = shape.metric;
  return options;
}

} // namespace

TEST(SimplexForces, MeanCurvatureIsExactOnASphere)
{
  for (const double radius : { 0.5, 20. })
    for (const auto& [back, front] : meanCurvatures(unevenSphere(radius, 2, 1, 2)))
    {
      EXPECT_NEAR(back * radius, 1, 1e-12);
      EXPECT_NEAR(front * radius, -1, 1e-12) << "the tissue around it is concave there";
    }
}

TEST(SimplexForces, ASphereKeepsItsPlaceUnderC2)
{
  // However unevenly its vertices are spread: where they slide to is on the sphere as well.
  for (const int rigidity : { 0, 1, 4 })
  {
    InternalForceOptions options;
    options.rigidity = rigidity;
    for (const Label outside : { 0, 2 })
    {
      const SimplexMesh mesh = unevenSphere(3, 2, 1, outside);
      const std::vector<Vec3> forces = internalForces(mesh, options);
      EXPECT_GT(largest(forces), 0.01);
      for (std::size_t v = 0; v < forces.size(); ++v) EXPECT_NEAR(norm(mesh.points[v] + forces[v]), 3, 1e-12);
    }
  }
}

TEST(SimplexForces, C0SlidesAlongTheVertexsOwnSphere)
{
  const SimplexMesh mesh = unevenSphere(3, 2);
  InternalForceOptions options;
  options.continuity = Continuity::C0;
  const std::vector<Vec3> forces = internalForces(mesh, options);
  for (std::size_t v = 0; v < forces.size(); ++v) EXPECT_NEAR(norm(mesh.points[v] + forces[v]), 3, 1e-12);
}

TEST(SimplexForces, C0WithTheMetricParametersItHasLeavesAVertex)
{
  const SimplexMesh mesh = unevenSphere(3, 1);
  const auto& n = mesh.neighbours[5][0];
  const SimplexShape shape = simplexShape(mesh.points[5], { mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]] });
  EXPECT_LT(norm(internalForces(mesh, keepingMetric(shape, Continuity::C0))[5]), 1e-12);
  EXPECT_GT(norm(internalForces(mesh, keepingMetric(shape, Continuity::C1))[5]), 0.01);
}

TEST(SimplexForces, C1LeadsToThePlaneOfTheNeighbours)
{
  const SimplexMesh mesh = unevenSphere(3, 2, 1, 0);
  InternalForceOptions options;
  options.continuity = Continuity::C1;
  const std::vector<Vec3> forces = internalForces(mesh, options);
  for (std::size_t v = 0; v < forces.size(); ++v)
  {
    const auto& n = mesh.neighbours[v][0];
    const Vec3 centroid = (mesh.points[n[0]] + mesh.points[n[1]] + mesh.points[n[2]]) / 3;
    EXPECT_LT(norm(mesh.points[v] + forces[v] - centroid), 1e-12);
  }
}

TEST(SimplexForces, C2FlattensADentOnlyAsFarAsItsNeighbourhoodIsCurved)
{
  SimplexMesh mesh = unevenSphere(3, 3);
  const std::size_t dented = 17;
  mesh.points[dented] = 0.9 * mesh.points[dented];
  InternalForceOptions options;
  options.rigidity = 6;
  const Vec3 healed = mesh.points[dented] + internalForces(mesh, options)[dented];
  EXPECT_NEAR(norm(healed), 3, 0.03);
}

TEST(SimplexForces, ASharedVertexHearsBothTissues)
{
  // Beside a junction the neighbours on the two surfaces differ, and the force is the mean of both.
  const TissueMap map =
    paintedMap({ 6, 6, 6 },
               [](int i, int j, int k) {
                 return i < 1 || j < 1 || k < 1 || i > 4 || j > 4 || k > 4 ? 0 : k > 2 ? 3 : i > 2 ? 2 : 1;
               });
  const SimplexMesh mesh = simplexMeshOf(smoothedBoundary(map));
  InternalForceOptions options;
  options.continuity = Continuity::C1;
  const std::vector<Vec3> forces = internalForces(mesh, options);
  int beside = 0;
  for (std::size_t v = 0; v < forces.size(); ++v)
  {
    Vec3 mean;
    for (const auto& three : mesh.neighbours[v])
      for (std::int32_t n : three) mean += mesh.points[n] / 6;
    EXPECT_LT(norm(mesh.points[v] + forces[v] - mean), 1e-12);
    beside += mesh.neighbours[v][0] != mesh.neighbours[v][1];
  }
  EXPECT_GT(beside, 20);
}

TEST(SimplexForces, ImageForceLeadsToTheBoundaryOfTheSamePairOnly)
{
  SurfaceComplex reference = sphere({}, 5, 5, 1, 2);
  append(reference, sphere({}, 4.6, 5, 2, 3));
  const TissueBoundary boundary(reference, 3);
  SurfaceComplex mesh = sphere({}, 4.5, 3, 1, 2);
  std::vector<double> distances;
  std::vector<Vec3> forces = imageForces(mesh, boundary, &distances);
  for (std::size_t t = 0; t < forces.size(); ++t)
  {
    EXPECT_NEAR(norm(forces[t]), 0.52, 0.03) << "not 0.1, to the other boundary";
    EXPECT_GT(dot(forces[t], mesh.points[mesh.triangles[t][0]]), 0);
    EXPECT_NEAR(distances[t], 0.53, 0.03);
  }
  mesh.labels.assign(mesh.triangles.size(), { 1, 7 });
  EXPECT_EQ(largest(imageForces(mesh, boundary)), 0);
}

TEST(SimplexForces, TrianglesAtRestInTheImageEncloseItsVolume)
{
  // Corners outside, centroids inside the sphere such that no force is left.
  const double radius = 5;
  const TissueBoundary boundary(sphere({}, radius, 6), 3);
  double low = 0.95, high = 1.05;
  const auto push = [&](double share)
  {
    double sum = 0;
    const SurfaceComplex mesh = sphere({}, share * radius, 2);
    const std::vector<Vec3> forces = imageForces(mesh, boundary);
    for (std::size_t t = 0; t < forces.size(); ++t) sum += dot(forces[t], mesh.points[mesh.triangles[t][0]]);
    return sum;
  };
  for (int n = 0; n < 40; ++n) (push(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  const double exact = 4. / 3 * std::acos(-1.) * radius * radius * radius;
  EXPECT_LT(checkSurface(sphere({}, radius, 2)).at(1).volume / exact, 0.95) << "with its corners on the sphere";
  EXPECT_NEAR(checkSurface(sphere({}, low * radius, 2)).at(1).volume / exact, 1, 0.01);
}

TEST(TissueBoundary, NearestPointIsTheNearest)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-4, 4);
  const SurfaceComplex surface = torus(3, 1, 14, 9);
  const TissueBoundary boundary(surface, 20);
  for (int n = 0; n < 100; ++n)
  {
    const Vec3 p{ unit(random), unit(random), unit(random) };
    double best = 1e9;
    for (const auto& [a, b, c] : surface.triangles)
      best = std::min(best, norm(nearestOnTriangle(p, surface.points[a], surface.points[b], surface.points[c]) - p));
    const auto nearest = boundary.nearest(p, { 1, 0 });
    ASSERT_TRUE(nearest);
    EXPECT_NEAR(nearest->distance, best, 1e-12);
    EXPECT_NEAR(norm(nearest->position - p), best, 1e-12);
    EXPECT_EQ(nearest->normal, -boundary.nearest(p, { 0, 1 })->normal);
  }
}

} // namespace surgicalmesher
