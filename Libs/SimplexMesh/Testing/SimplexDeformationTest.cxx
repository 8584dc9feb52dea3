// SPDX-License-Identifier: Apache-2.0
#include "SimplexDeformation.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "Shapes.h"
#include "UniformLimits.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

namespace surgicalmesher
{
using namespace test;
namespace
{

TissueMap ball(double radius, const Vec3& spacing = { 1, 1, 1 })
{
  const int n = int(2 * radius) + 7;
  return paintedMap(
    { n, n, n },
    [=](int i, int j, int k)
    {
      const double c = 0.5 * (n - 1);
      return (i - c) * (i - c) + (j - c) * (j - c) + (k - c) * (k - c) < radius * radius ? 1 : 0;
    },
    spacing);
}

/// Root mean square of the angles between the normals of neighbouring triangles, degrees.
double roughness(const SurfaceComplex& surface)
{
  const SimplexMesh mesh = simplexMeshOf(surface);
  const auto normal = [&](std::int32_t t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    return cross(surface.points[b] - surface.points[a], surface.points[c] - surface.points[a]);
  };
  double sum = 0;
  for (std::size_t t = 0; t < mesh.points.size(); ++t)
    for (std::int32_t n : mesh.neighbours[t][0])
    {
      const Vec3 x = normal(std::int32_t(t)), y = normal(n);
      const double angle = std::atan2(norm(cross(x, y)), dot(x, y)) * 180 / std::acos(-1.);
      sum += angle * angle;
    }
  return std::sqrt(sum / (3. * double(mesh.points.size())));
}

} // namespace

TEST(SimplexMotion, ComesToRest)
{
  const SurfaceComplex dense = smoothedBoundary(ball(4));
  const TissueBoundary boundary(dense, 5);
  for (const Continuity continuity : { Continuity::C1, Continuity::C2 })
  {
    SimplexOperators mesh(dense, boundary, limitsOf(1, 2));
    MotionOptions options;
    options.internalForce.continuity = continuity;
    const std::vector<double> ways = relaxSimplexMesh(mesh, boundary, options, 120, 0.002);
    EXPECT_LE(ways.back(), 0.002) << int(continuity);
    requireSound(mesh.surface(), "motion");
  }
}

TEST(SimplexMotion, TakesAwayTheStaircaseAndKeepsTheVolume)
{
  for (const Vec3& spacing : { Vec3{ 1, 1, 1 }, Vec3{ 0.9, 0.9, 1.6 } })
  {
    const TissueMap map = ball(5, spacing);
    const SurfaceComplex stairs = interfaceOf(tetrahedraOf(map)), dense = smoothedBoundary(map);
    const TissueBoundary boundary(dense, 5);
    SimplexOperators mesh(stairs, boundary, limitsOf(1, 2));
    relaxSimplexMesh(mesh, boundary, {}, 40, 0.002);
    const SurfaceComplex after = mesh.surface();
    EXPECT_GT(roughness(stairs), 40);
    EXPECT_LT(roughness(after), 15);
    const double voxels = checkSurface(stairs).at(1).volume;
    EXPECT_NEAR(checkSurface(after).at(1).volume / voxels, 1, 0.015);
  }
}

TEST(SimplexMotion, C1ShrinksWhatC2Keeps)
{
  // Without an image: what the internal forces alone do to a sphere.
  const SurfaceComplex start = sphere({}, 6, 3);
  const TissueBoundary nowhere(sphere({ 100, 0, 0 }, 1, 1), 1);
  const auto volumeAfter = [&](Continuity continuity)
  {
    OperatorLimits limits = limitsOf(1, 1);
    SimplexOperators mesh(start, nowhere, limits);
    MotionOptions options;
    options.internalForce.continuity = continuity;
    relaxSimplexMesh(mesh, nowhere, options, 40, 0);
    return checkSurface(mesh.surface()).at(1).volume / checkSurface(start).at(1).volume;
  };
  EXPECT_LT(volumeAfter(Continuity::C1), 0.9);
  EXPECT_NEAR(volumeAfter(Continuity::C2), 1, 0.05);
}

TEST(SimplexMotion, SharedBoundariesStayShared)
{
  // A ball of two halves: the disc between them stays flat, and ends on the curve between all three.
  const TissueMap map =
    paintedMap({ 21, 21, 21 }, [](int i, int j, int k)
               { return (i - 10) * (i - 10) + (j - 10) * (j - 10) + (k - 10) * (k - 10) < 64 ? (k < 10 ? 1 : 2) : 0; });
  const SurfaceComplex dense = smoothedBoundary(map);
  const TissueBoundary boundary(dense, 5);
  SimplexOperators mesh(dense, boundary, limitsOf(2.5, 0.7));
  AdaptationOptions options;
  options.mostIterations = 10;
  adaptSimplexMesh(mesh, boundary, options);
  const SurfaceComplex after = mesh.surface();
  requireSound(after, "adaptation");
  for (const auto& [label, tissue] : checkSurface(dense))
    EXPECT_NEAR(checkSurface(after).at(label).volume / tissue.volume, 1, 0.04) << label;
  int between = 0;
  for (std::size_t t = 0; t < after.triangles.size(); ++t)
  {
    if (after.labels[t] != std::array<Label, 2>{ 2, 1 }) continue;
    ++between;
    for (std::int32_t p : after.triangles[t]) EXPECT_NEAR(after.points[p].z, 9.5, 0.7);
  }
  EXPECT_GT(between, 10);
}

TEST(SimplexAdaptation, EdgesComeToScaleAndFacesToRest)
{
  const TissueMap map = ball(10);
  const SurfaceComplex dense = smoothedBoundary(map);
  const TissueBoundary boundary(dense, 5);
  OperatorLimits limits = limitsOf(0, 1.2);
  limits.edgeLength = [](const Vec3& p) { return p.x < 8 ? 1.5 : std::min(4., 1.5 + 0.25 * (p.x - 8)); };
  SimplexOperators mesh(dense, boundary, limits);
  AdaptationOptions options;
  const std::vector<SimplexStep> steps = adaptSimplexMesh(mesh, boundary, options);
  const SurfaceComplex after = mesh.surface();
  requireSound(after, "adaptation");
  EXPECT_EQ(checkSurface(after).at(1).euler, 2);
  EXPECT_LT(int(steps.size()), options.mostIterations) << "T1 and T2 offset each other before the end";
  const SimplexStep& rest = steps[steps.size() - 2];
  EXPECT_LT(std::abs(rest.t1 - rest.t2), 0.05 * double(after.points.size()));
  EXPECT_EQ(steps.back().faces, after.points.size());
  EXPECT_EQ(steps.back().vertices, after.triangles.size());
  int good = 0;
  for (const auto& [a, b, c] : after.triangles)
    for (const auto& [from, to] : { std::pair{ a, b }, { b, c }, { c, a } })
    {
      const double ratio =
        norm(after.points[from] - after.points[to]) / limits.edgeLength(0.5 * (after.points[from] + after.points[to]));
      good += ratio > 0.7 && ratio < 1.4;
    }
  EXPECT_GT(good, 0.85 * 3 * double(after.triangles.size()));
  for (std::int32_t a = 0; a < std::int32_t(mesh.points().size()); ++a) EXPECT_LE(mesh.mostVertices(a), 8u);
}

TEST(SimplexAdaptation, ATightProximityBoundCostsFacesWhereTheBoundaryIsCurved)
{
  const SurfaceComplex dense = smoothedBoundary(ball(7));
  const TissueBoundary boundary(dense, 5);
  const auto adapted = [&](double proximity)
  {
    SimplexOperators mesh(dense, boundary, limitsOf(5, proximity));
    AdaptationOptions options;
    options.mostIterations = 20;
    return adaptSimplexMesh(mesh, boundary, options);
  };
  const std::vector<SimplexStep> tight = adapted(0.3), loose = adapted(1.5);
  EXPECT_GT(double(tight.back().faces), 1.3 * double(loose.back().faces));
  EXPECT_LT(tight.back().maximumDistance, loose.back().maximumDistance);
  int cuts = 0;
  for (const SimplexStep& step : tight) cuts += step.t2;
  EXPECT_GT(cuts, 0) << "T2 keeps faces near the boundary";
}

TEST(SimplexAdaptation, BytesDoNotDependOnThreads)
{
  const SurfaceComplex dense = smoothedBoundary(ball(5));
  const TissueBoundary boundary(dense, 5);
  const auto adapted = [&](int threads)
  {
    vtkSMPTools::Initialize(threads);
    SimplexOperators mesh(dense, boundary, limitsOf(2, 1));
    AdaptationOptions options;
    options.mostIterations = 3;
    adaptSimplexMesh(mesh, boundary, options);
    return mesh.surface();
  };
  const SurfaceComplex one = adapted(1), two = adapted(2);
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.triangles, two.triangles);
}

TEST(SimplexAdaptation, EvolutionHasARowForEachStep)
{
  const std::string csv = evolutionCSV({ SimplexStep{}, SimplexStep{} });
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 3 * 8);
}

} // namespace surgicalmesher
