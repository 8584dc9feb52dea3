// SPDX-License-Identifier: Apache-2.0
#include "SimplexOperators.h"
#include "MeshChecks.h"
#include "RandomMaps.h"
#include "Shapes.h"
#include "SimplexDeformation.h"
#include "UniformLimits.h"

#include <gtest/gtest.h>

#include <set>

namespace surgicalmesher
{
using namespace test;
namespace
{

/// Pairs of triangles of a surface that cross.
int crossings(const SurfaceComplex& surface)
{
  int count = 0;
  const auto shape = [&](std::size_t t)
  {
    const auto& c = surface.triangles[t];
    return CornerTriangle{ { surface.points[c[0]], surface.points[c[1]], surface.points[c[2]] }, c };
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t s = 0; s < t; ++s) count += trianglesCross(shape(t), shape(s));
  return count;
}

/// What every operation has to leave: sound surfaces of the same topology, between the same tissues, that don't cross.
void expectSameTissues(const SurfaceComplex& before, const SurfaceComplex& after)
{
  EXPECT_NO_THROW(requireSound(after, "operators"));
  const auto wanted = checkSurface(before), got = checkSurface(after);
  ASSERT_EQ(got.size(), wanted.size());
  for (const auto& [label, tissue] : wanted) EXPECT_EQ(got.at(label).euler, tissue.euler) << label;
  std::set<std::array<Label, 2>> pairsBefore, pairsAfter;
  for (auto [a, b] : before.labels) pairsBefore.insert({ std::min(a, b), std::max(a, b) });
  for (auto [a, b] : after.labels) pairsAfter.insert({ std::min(a, b), std::max(a, b) });
  EXPECT_EQ(pairsBefore, pairsAfter);
  EXPECT_EQ(crossings(after), 0);
}

TissueMap preparedMap(unsigned seed, int labels)
{
  std::mt19937 random(seed);
  return randomWellComposedMap(random, { 8, 7, 9 }, labels, 90);
}

CornerTriangle shapeOf(const Vec3& a, const Vec3& b, const Vec3& c, std::array<std::int32_t, 3> ids = { 0, 1, 2 })
{
  return { { a, b, c }, ids };
}

} // namespace

TEST(TriangleCrossing, KnowsApartFromAcross)
{
  const CornerTriangle flat = shapeOf({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 });
  const auto with = [&](const Vec3& a, const Vec3& b, const Vec3& c, std::array<std::int32_t, 3> ids = { 7, 8, 9 })
  {
    const CornerTriangle other = shapeOf(a, b, c, ids);
    EXPECT_EQ(trianglesCross(flat, other), trianglesCross(other, flat));
    return trianglesCross(flat, other);
  };
  EXPECT_TRUE(with({ 1, 1, -1 }, { 1, 1, 1 }, { 9, 9, 0 })) << "pierces";
  EXPECT_FALSE(with({ 5, 5, -1 }, { 5, 5, 1 }, { 9, 9, 0 }));
  EXPECT_FALSE(with({ 1, 1, 0.01 }, { 1, 2, 0.01 }, { 2, 1, 0.01 })) << "above";
  EXPECT_TRUE(with({ 1, 1, 0 }, { 2, 1, 0 }, { 1, 2, 0 })) << "within, in the plane";
  EXPECT_TRUE(with({ -1, 1, 0 }, { 9, 1, 0 }, { 9, 2, 0 })) << "across, in the plane";
  EXPECT_FALSE(with({ 5, 5, 0 }, { 6, 5, 0 }, { 5, 6, 0 })) << "beside, in the plane";
  EXPECT_FALSE(with({ 0, 0, 0 }, { -1, 0, 1 }, { 0, -1, 1 }, { 0, 8, 9 })) << "meets in the common corner only";
  EXPECT_TRUE(with({ 0, 0, 0 }, { 2, 2, 1 }, { 2, 2, -1 }, { 0, 8, 9 })) << "one corner, and the plane pierced";
  EXPECT_FALSE(with({ 4, 0, 0 }, { 0, 0, 0 }, { 2, -3, 0 }, { 1, 0, 9 })) << "next in the plane";
  EXPECT_FALSE(with({ 4, 0, 0 }, { 0, 0, 0 }, { 2, 2, 3 }, { 1, 0, 9 }));
  EXPECT_TRUE(with({ 4, 0, 0 }, { 0, 0, 0 }, { 2, 2, 0.1 }, { 1, 0, 9 })) << "folded";
  EXPECT_TRUE(with({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 2, 1, 0 })) << "the same";
}

TEST(SimplexOperators, CountsAreThoseOfTheDual)
{
  const SurfaceComplex ball = sphere({}, 5, 2);
  const TissueBoundary boundary(ball, 5);
  SimplexOperators mesh(ball, boundary, limitsOf(2, 2));
  const auto faces = mesh.faceCount(), vertices = mesh.surface().triangles.size();
  const std::int32_t a = 20;
  const auto around = mesh.faceNeighbours(a);
  ASSERT_TRUE(std::any_of(around.begin(), around.end(), [&](std::int32_t b) { return mesh.swap(a, b); }));
  EXPECT_EQ(mesh.faceCount(), faces);
  EXPECT_EQ(mesh.surface().triangles.size(), vertices);

  const std::int32_t next = mesh.faceNeighbours(a)[0];
  ASSERT_TRUE(mesh.fuse(a, next));
  EXPECT_EQ(mesh.faceCount(), faces - 1);
  EXPECT_EQ(mesh.surface().triangles.size(), vertices - 2);
  EXPECT_FALSE(mesh.alive(next));

  ASSERT_TRUE(mesh.cut(a));
  EXPECT_EQ(mesh.faceCount(), faces);
  EXPECT_EQ(mesh.surface().triangles.size(), vertices);
  expectSameTissues(ball, mesh.surface());
}

TEST(SimplexOperators, SwapOfTheNewEdgeUndoesASwap)
{
  const SurfaceComplex ball = sphere({}, 5, 2);
  const TissueBoundary boundary(ball, 5);
  SimplexOperators mesh(ball, boundary, limitsOf(2, 2));
  const std::int32_t a = 30, b = mesh.faceNeighbours(a)[1];
  const auto before = mesh.faceNeighbours(a);
  const auto [c, d] = mesh.endsOf(a, b);
  ASSERT_TRUE(mesh.swap(a, b));
  EXPECT_NE(mesh.faceNeighbours(a), before);
  ASSERT_TRUE(mesh.swap(c, d));
  EXPECT_EQ(mesh.faceNeighbours(a), before);
}

TEST(SimplexOperators, RandomOperationsKeepEveryTissue)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const SurfaceComplex surface = smoothedBoundary(preparedMap(seed, 1 + int(seed) % 4));
    const TissueBoundary boundary(surface, 5);
    OperatorLimits limits = limitsOf(2, 3); // hardly any guard but those of topology and crossings
    limits.minimumQuality = 0.02;
    limits.minimumCosine = -1;
    SimplexOperators mesh(surface, boundary, limits);
    std::mt19937 random(seed);
    std::array<int, 4> done{};
    for (int n = 0; n < 4000; ++n)
    {
      const auto a = std::int32_t(random() % mesh.points().size());
      if (!mesh.alive(a)) continue;
      const auto around = mesh.faceNeighbours(a);
      const std::int32_t b = around[random() % around.size()];
      const int kind = int(random() % 8);
      const Vec3 way{ 1e-4 * (random() % 2000) - 0.1, 1e-4 * (random() % 2000) - 0.1, 1e-4 * (random() % 2000) - 0.1 };
      if (kind < 4) done[0] += mesh.fuse(a, b);
      else if (kind == 4) done[1] += mesh.cut(a);
      else if (kind == 5) done[2] += mesh.swap(a, b);
      else done[3] += mesh.move(a, mesh.points()[a] + way);
    }
    for (int count : done) EXPECT_GT(count, 5);
    expectSameTissues(surface, mesh.surface());
  }
}

TEST(SimplexOperators, RefusesWhatWouldChangeATissue)
{
  // A tetrahedron has nothing to fuse, and a thin ring nothing around its hole.
  SurfaceComplex tetrahedron;
  tetrahedron.points = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 } };
  tetrahedron.triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } };
  tetrahedron.labels.assign(4, { 1, 0 });
  const SurfaceComplex ring = torus(4, 1, 9, 3);
  for (const SurfaceComplex& surface : { tetrahedron, ring })
  {
    const TissueBoundary boundary(surface, 20);
    OperatorLimits limits = limitsOf(50, 50);
    limits.minimumQuality = 0;
    limits.minimumCosine = -1;
    SimplexOperators mesh(surface, boundary, limits);
    for (std::int32_t a = 0; a < std::int32_t(surface.points.size()); ++a)
      for (std::int32_t b = 0; b < a; ++b)
        if (mesh.alive(a) && mesh.alive(b)) mesh.fuse(a, b);
    expectSameTissues(surface, mesh.surface());
    EXPECT_GE(mesh.faceCount(), 4u);
  }
}

TEST(SimplexOperators, KeepsTheProximityBound)
{
  const SurfaceComplex ball = sphere({}, 6, 3);
  const TissueBoundary boundary(ball, 5);
  for (const double proximity : { 0.25, 1. })
  {
    SimplexOperators mesh(ball, boundary, limitsOf(100, proximity));
    AdaptationOptions options;
    options.mostIterations = 5;
    adaptSimplexMesh(mesh, boundary, options);
    const SurfaceComplex surface = mesh.surface();
    const TissueBoundary back(surface, 5);
    double uncovered = 0;
    for (const Vec3& p : ball.points) uncovered = std::max(uncovered, back.nearest(p, { 1, 0 })->distance);
    EXPECT_LT(uncovered, 1.5 * proximity);
    EXPECT_LT(surface.points.size(), 0.7 * double(ball.points.size())) << "and the scale asks for large faces";
    expectSameTissues(ball, surface);
  }
}

TEST(SimplexOperators, MoveIsRefusedWhereItFoldsOrCrosses)
{
  SurfaceComplex two = sphere({}, 5, 2);
  append(two, sphere({ 11, 0, 0 }, 5, 2, 2));
  const TissueBoundary boundary(two, 5);
  SimplexOperators mesh(two, boundary, limitsOf(2, 50));
  std::int32_t pole = 0;
  for (std::size_t p = 0; p < two.points.size(); ++p)
    if (two.points[p].x > two.points[pole].x && two.points[p].x < 5.5) pole = std::int32_t(p);
  EXPECT_TRUE(mesh.move(pole, { 5.2, 0, 0 }));
  EXPECT_FALSE(mesh.move(pole, { 6.5, 0, 0 })) << "the other ball";
  EXPECT_FALSE(mesh.move(pole, { 5.2, 4, 0 })) << "beyond its neighbours";
  expectSameTissues(two, mesh.surface());
}

} // namespace surgicalmesher
