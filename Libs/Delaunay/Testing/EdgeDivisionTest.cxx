// SPDX-License-Identifier: Apache-2.0
// Large triangles become small ones of the same shape.
#include "EdgeDivision.h"

#include "Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace surgicalmesher::test
{
namespace
{

/// A cube of 20 mm around the origin, of twelve triangles.
SurfaceComplex cube()
{
  SurfaceComplex surface;
  for (int n = 0; n < 8; ++n) surface.points.push_back({ n & 1 ? 10. : -10., n & 2 ? 10. : -10., n & 4 ? 10. : -10. });
  surface.triangles = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
                        { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  surface.labels.assign(12, { 5, 0 });
  return surface;
}

double volumeOf(const SurfaceComplex& surface)
{
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles)
    volume += dot(surface.points[a], cross(surface.points[b], surface.points[c])) / 6;
  return volume;
}

// B4: triangles far longer than L were kept as they were, and the mesh between them bulged or did not end.
TEST(Trial, B04_TheTwelveTrianglesOfACubeAreDividedAndItsShapeStays)
{
  for (const double length : { 0.5, 1., 1.5, 2., 3., 5. })
  {
    const SurfaceComplex divided = withDividedEdges(cube(), [&](const Vec3&) { return length; });
    EXPECT_NEAR(volumeOf(divided), 8000, 1e-6) << length;
    std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
    double longest = 0, shortest = 1e9;
    for (const auto& ids : divided.triangles)
    {
      for (int n = 0; n < 3; ++n)
      {
        const std::int32_t a = ids[n], b = ids[(n + 1) % 3];
        sides[std::minmax(a, b)] += a < b ? 1 : -1;
        longest = std::max(longest, norm(divided.points[a] - divided.points[b]));
        shortest = std::min(shortest, norm(divided.points[a] - divided.points[b]));
      }
    }
    for (const auto& [edge, balance] : sides) ASSERT_EQ(balance, 0);
    EXPECT_LE(longest, 1.8 * length);
    EXPECT_GE(shortest, 0.6 * length);
    for (const Vec3& p : divided.points) // on the cube
      EXPECT_EQ(std::max({ std::abs(p.x), std::abs(p.y), std::abs(p.z) }), 10);
    EXPECT_EQ(divided.labels, decltype(divided.labels)(divided.triangles.size(), { 5, 0 }));
  }
}

TEST(EdgeDivision, LeavesSurfacesOfTheScaleAlone)
{
  const SurfaceComplex ball = sphere({ 0, 0, 0 }, 10, 3);
  const SurfaceComplex same = withDividedEdges(ball, [](const Vec3&) { return 2.; });
  EXPECT_EQ(same.triangles, ball.triangles);
  EXPECT_EQ(same.points.size(), ball.points.size());
}

// Halving what is too long alone, whatever its triangles' other sides, did not end here.
TEST(EdgeDivision, EndsWhereLengthsJump)
{
  const auto jumping = [](const Vec3& p) { return p.x < -5 ? 1. : 3.; };
  const SurfaceComplex ball = sphere({ 0, 0, 0 }, 10, 2);
  const SurfaceComplex divided = withDividedEdges(ball, jumping);
  EXPECT_GT(divided.triangles.size(), ball.triangles.size());
  EXPECT_LT(divided.triangles.size(), 20 * ball.triangles.size());
}

TEST(EdgeDivision, FollowsAGradedScale)
{
  const auto graded = [](const Vec3& p) { return p.x < 0 ? 1. : 4.; };
  const SurfaceComplex divided = withDividedEdges(cube(), graded);
  for (const auto& ids : divided.triangles)
  {
    for (int n = 0; n < 3; ++n)
    {
      const Vec3 &a = divided.points[ids[n]], &b = divided.points[ids[(n + 1) % 3]];
      EXPECT_LE(norm(a - b), 1.8 * graded(0.5 * (a + b)));
    }
  }
  EXPECT_NEAR(volumeOf(divided), 8000, 1e-6);
}

} // namespace
} // namespace surgicalmesher::test
