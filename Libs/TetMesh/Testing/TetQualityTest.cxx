// SPDX-License-Identifier: Apache-2.0
#include "TetQuality.h"
#include "MeshQuality.h"

#include <gtest/gtest.h>

#include <random>

namespace surgicalmesher
{
namespace
{

using Corners = std::array<Vec3, 4>;

double worst(const Corners& p) { return worstSine2(p[0], p[1], p[2], p[3]); }

Corners regular() { return { Vec3{ 1, 1, 1 }, { -1, 1, -1 }, { 1, -1, -1 }, { -1, -1, 1 } }; }

/// Two ends of a cube's edge, the centres of two cubes beside it.
Corners canonical() { return { Vec3{ 0, 0, 0 }, { 2, 0, 0 }, { 1, 1, 1 }, { 1, 1, -1 } }; }

Corners positive(Corners p)
{
  if (orient(p[0], p[1], p[2], p[3]) < 0) std::swap(p[2], p[3]);
  return p;
}

Corners randomCorners(std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  Corners p;
  for (Vec3& x : p) x = { uniform(random), uniform(random), uniform(random) };
  return positive(p);
}

} // namespace

TEST(WorstSine2, KnowsTheRegularAndTheCanonicalTetrahedron)
{
  EXPECT_NEAR(worst(positive(regular())), 8.0 / 9, 1e-14) << "dihedral angles of acos(1/3), 70.53 degrees";
  EXPECT_NEAR(worst(positive(canonical())), 0.75, 1e-14) << "four of 60 and two of 90 degrees";
}

TEST(WorstSine2, CountsSmallAndLargeAnglesAlike)
{
  for (double degrees : { 5.0, 30.0, 60.0, 120.0, 150.0, 175.0 })
  {
    // Two long triangles hinged along the x axis: their angle there is the worst, if it is far from 90.
    const double angle = degrees * std::acos(-1.0) / 180;
    const Corners p = positive({ Vec3{ -1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, std::cos(angle), std::sin(angle) } });
    const auto angles = dihedralAngles(p[0], p[1], p[2], p[3]);
    double expected = 1;
    for (double a : angles) expected = std::min(expected, sine2OfDegrees(a));
    EXPECT_NEAR(worst(p), expected, 1e-12) << degrees;
    EXPECT_LE(worst(p), sine2OfDegrees(degrees) + 1e-12);
  }
  EXPECT_NEAR(sine2OfDegrees(30), 0.25, 1e-15);
  EXPECT_NEAR(sine2OfDegrees(150), 0.25, 1e-15);
}

TEST(WorstSine2, IsTheSineOfTheWorstDihedralAngle)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 1000; ++trial)
  {
    const Corners p = randomCorners(random);
    double expected = 1;
    for (double a : dihedralAngles(p[0], p[1], p[2], p[3])) expected = std::min(expected, sine2OfDegrees(a));
    EXPECT_NEAR(worst(p), expected, 1e-9);
  }
}

TEST(WorstSine2, IsNegativeForFlatAndInverted)
{
  EXPECT_LT(worst({ Vec3{ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } }), 0) << "four points of a plane";
  EXPECT_LT(worst({ Vec3{ 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 1 } }), 0) << "three points of a line";
  EXPECT_LT(worst({ Vec3{ 1, 2, 3 }, { 1, 2, 3 }, { 0, 1, 0 }, { 0, 1, 1 } }), 0) << "a point twice";
  EXPECT_LT(worst({}), 0) << "one point";
  Corners p = positive(regular());
  std::swap(p[0], p[1]);
  EXPECT_LT(worst(p), 0);
}

TEST(WorstSine2, TakesTheCornersInAnyEvenOrder)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Corners p = randomCorners(random);
    std::array<int, 4> order{ 0, 1, 2, 3 };
    do {
      int inversions = 0;
      for (int i = 0; i < 4; ++i)
      {
        for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
      }
      const double q = worst({ p[order[0]], p[order[1]], p[order[2]], p[order[3]] });
      if (inversions % 2 == 0) EXPECT_NEAR(q, worst(p), 1e-9 * worst(p));
      else EXPECT_LT(q, 0);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(WorstSine2, DoesNotDependOnSizeOrPlace)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Corners p = randomCorners(random);
    for (double size : { 1e-3, 1e3 })
    {
      Corners q = p;
      for (Vec3& x : q) x = size * (x + Vec3{ 1, -2, 3 });
      EXPECT_NEAR(worst(q), worst(p), 1e-8);
    }
  }
}

} // namespace surgicalmesher
