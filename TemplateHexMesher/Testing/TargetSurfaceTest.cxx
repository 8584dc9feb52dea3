// SPDX-License-Identifier: Apache-2.0
#include "TargetSurface.h"

#include "Slab.h"
#include "SurfaceDistance.h"

#include <gtest/gtest.h>

#include <set>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

using Eigen::Vector3d;

/// The unit square of two triangles in the plane of this height.
TriangleSurface square(double z)
{
  TriangleSurface surface{ Points(3, 4), { { 0, 1, 2 }, { 0, 2, 3 } } };
  surface.points << 0, 1, 1, 0, 0, 0, 1, 1, z, z, z, z;
  return surface;
}

std::set<std::set<std::int32_t>> asSets(const std::vector<Triangle>& triangles)
{
  std::set<std::set<std::int32_t>> sets;
  for (const Triangle& t : triangles) sets.insert({ t[0], t[1], t[2] });
  return sets;
}

} // namespace

TEST(TargetSurface, PrefersTheSideThatFacesTheSameWay)
{
  TriangleSurface plate = square(0);
  const TriangleSurface back = square(-0.1);
  plate.points.conservativeResize(3, 8);
  plate.points.rightCols(4) = back.points;
  for (const Triangle& t : back.triangles) plate.triangles.push_back({ t[0] + 4, t[2] + 4, t[1] + 4 });
  const TargetSurface target(plate);
  const Vector3d point(0.5, 0.5, 0.2);
  EXPECT_NEAR(target.closest(point, -Vector3d::UnitZ(), 0).position.z(), 0, 1e-12);
  EXPECT_NEAR(target.closest(point, Vector3d::UnitZ(), 4).position.z(), 0, 1e-12);
  EXPECT_NEAR(target.closest(point, -Vector3d::UnitZ(), 4).position.z(), -0.1, 1e-12);
}

TEST(TargetSurface, KnowsItsOpenBorder)
{
  const TargetSurface target(square(0));
  EXPECT_FALSE(target.closest({ 0.5, 0.4, 1 }, Vector3d::UnitZ(), 0).onBorder);
  EXPECT_FALSE(target.closest({ 0.5, 0.5, 1 }, Vector3d::UnitZ(), 0).onBorder); // on the diagonal
  EXPECT_TRUE(target.closest({ 0.5, -0.5, 1 }, Vector3d::UnitZ(), 0).onBorder);
  EXPECT_TRUE(target.closest({ 2, 2, 0 }, Vector3d::UnitZ(), 0).onBorder);
}

TEST(TargetSurface, WindsNeighboursAlikeAndPartsLikeTheTemplate)
{
  const TriangleSurface surface = outerSurface(slab());
  std::vector<Triangle> mixed = surface.triangles;
  for (std::size_t t = 1; t < mixed.size(); t += 3) std::swap(mixed[t][1], mixed[t][2]);
  const std::vector<std::int32_t> parts = windAlike(mixed);
  EXPECT_EQ(std::set<std::int32_t>(parts.begin(), parts.end()).size(), 1u);
  EXPECT_EQ(asSets(mixed), asSets(surface.triangles));
  TriangleSurface turned = surface;
  for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  TargetSurface target(turned);
  const Points normals = cornerNormals(surface, kCreaseDegrees);
  Points places(3, Eigen::Index(surface.triangles.size())), directions = places;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    places.col(Eigen::Index(t)) = surface.points.col(surface.triangles[t][0]);
    directions.col(Eigen::Index(t)) = normals.col(3 * Eigen::Index(t));
  }
  target.orientLike(places, directions, 1);
  const SurfacePoint top = target.closest({ 0, 0, 11 }, Vector3d::UnitZ(), 0);
  EXPECT_GT(top.normal.z(), 0.9);
}

TEST(TargetSurface, FindsCreasesOfASlabAtItsEdgesAlone)
{
  const TriangleSurface surface = outerSurface(slab());
  for (const auto& edge : creasesOf(surface, kCreaseDegrees))
  {
    for (const std::int32_t id : edge)
      EXPECT_TRUE(std::abs(surface.points(0, id)) > 49.9 || std::abs(surface.points(1, id)) > 39.9);
  }
  const TargetSurface target(surface);
  EXPECT_GE(target.closestOnCrease({ 51, 0, -10 }, 12).triangle, 0);
  EXPECT_LT(target.closestOnCrease({ 0, 0, 10 }, 8).triangle, 0);
}

TEST(SurfaceDistance, IsThatOfParallelSquares)
{
  const DistanceSummary distance = distanceBetween(square(0.25), TargetSurface(square(0)));
  EXPECT_NEAR(distance.mean, 0.25, 1e-12);
  EXPECT_NEAR(distance.percentile95, 0.25, 1e-12);
  EXPECT_NEAR(distance.maximum, 0.25, 1e-12);
}
