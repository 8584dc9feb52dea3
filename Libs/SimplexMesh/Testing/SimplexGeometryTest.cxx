// SPDX-License-Identifier: Apache-2.0
#include "SimplexGeometry.h"

#include <gtest/gtest.h>

#include <random>

namespace surgicalmesher
{
namespace
{

const double pi = std::acos(-1.);

Vec3 onSphere(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const Vec3 p{ normal(random), normal(random), normal(random) };
  return p / norm(p);
}

/// Four points of the unit sphere, the last three counter-clockwise as seen from outside if their cap is less than half
/// of it.
struct FourOnSphere
{
  Vec3 p;
  SimplexNeighbours neighbours;
};

FourOnSphere fourOnSphere(std::mt19937& random)
{
  FourOnSphere four{ onSphere(random), { onSphere(random), onSphere(random), onSphere(random) } };
  return four;
}

} // namespace

TEST(SimplexGeometry, CircumCircleIsEquallyFarFromAllThree)
{
  std::mt19937 random(1);
  for (int n = 0; n < 200; ++n)
  {
    const SimplexNeighbours three = fourOnSphere(random).neighbours;
    const CircumCircle circle = circumCircle(three);
    const double tolerance = 1e-12 * std::max(1., 1 / norm(cross(three[1] - three[0], three[2] - three[0])));
    for (const Vec3& p : three)
    {
      EXPECT_NEAR(norm(p - circle.centre), circle.radius, tolerance);
      EXPECT_NEAR(dot(p - circle.centre, circle.normal), 0, tolerance);
    }
    EXPECT_NEAR(norm(circle.normal), 1, 1e-14);
    EXPECT_NEAR(norm(cross(circle.centre, circle.normal)), 0, tolerance)
      << "the axis passes through the sphere's centre";
  }
}

TEST(SimplexGeometry, AngleOnASphereIsThatOfTheCap)
{
  // The neighbours lie on the circle at polar angle theta, and P anywhere within: sin(phi) = r / R, whatever P. Past
  // the equator the angle passes 90 degrees.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double radius : { 0.3, 1., 25. })
    for (const double theta : { 0.01, 0.3, 1.2, pi / 2, 1.9, 2.8 })
      for (int n = 0; n < 20; ++n)
      {
        const auto at = [&](double polar, double azimuth) {
          return radius *
                 Vec3{ std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar) };
        };
        SimplexNeighbours three;
        for (int k = 0; k < 3; ++k) three[k] = at(theta, 2 * pi / 3 * (k + 0.6 * unit(random)));
        const Vec3 p = at(theta * 0.9 * unit(random), 2 * pi * unit(random));
        const SimplexShape shape = simplexShape(p, three);
        EXPECT_NEAR(shape.angle, theta, 1e-12) << radius << " " << theta;
        EXPECT_NEAR(shape.meanCurvature() * radius, 1, 1e-12 / std::sin(theta)) << radius << " " << theta;
        // The same surface seen from its other side is concave.
        const SimplexShape inside = simplexShape(p, { three[0], three[2], three[1] });
        EXPECT_NEAR(inside.angle, -theta, 1e-12);
        EXPECT_NEAR(inside.meanCurvature(), -shape.meanCurvature(), 1e-12 / radius / std::sin(theta));
      }
}

TEST(SimplexGeometry, PlaneHasNoAngleAndNoCurvature)
{
  const SimplexNeighbours three{ Vec3{ 1, 0, 3 }, { 0, 1, 3 }, { -1, -1, 3 } };
  const SimplexShape shape = simplexShape({ 0.1, 0.05, 3 }, three);
  EXPECT_EQ(shape.height, 0);
  EXPECT_EQ(shape.angle, 0);
  EXPECT_EQ(shape.meanCurvature(), 0);
  EXPECT_EQ(shape.circle.normal, (Vec3{ 0, 0, 1 }));
  EXPECT_EQ(simplexHeight(shape.circle.radius, shape.offset, 0), 0);
}

TEST(SimplexGeometry, MetricParametersAndAngleReproduceTheVertex)
{
  std::mt19937 random(3);
  int beyond = 0, tested = 0;
  for (int n = 0; n < 2000; ++n)
  {
    const FourOnSphere four = fourOnSphere(random);
    const SimplexShape shape = simplexShape(four.p, four.neighbours);
    EXPECT_NEAR(shape.metric[0] + shape.metric[1] + shape.metric[2], 1, 1e-9);
    // Flat triangles and feet on the circle are left out: there the parameters themselves are uncertain.
    if (shape.circle.radius < 0.1 || shape.offset > 0.98 * shape.circle.radius) continue;
    if (norm(cross(four.neighbours[1] - four.neighbours[0], four.neighbours[2] - four.neighbours[0])) < 0.05) continue;
    ++tested;
    beyond += std::abs(shape.angle) > pi / 2;
    const Vec3 back = simplexPosition(four.neighbours, shape.metric, shape.angle);
    EXPECT_NEAR(norm(back - four.p), 0, 1e-12) << "phi " << shape.angle;
  }
  EXPECT_GT(tested, 200);
  EXPECT_GT(beyond, 50) << "the branch beyond 90 degrees has to be among them";
}

TEST(SimplexGeometry, HeightAndAngleAreInverseAndMonotonous)
{
  for (const double radius : { 0.5, 2., 10. })
    for (const double share : { 0., 0.3, 0.9, 0.999 })
    {
      double last = -1e300;
      for (double angle = -3.1; angle < 3.1; angle += 0.05)
      {
        const double height = simplexHeight(radius, share * radius, angle);
        EXPECT_GT(height, last) << angle;
        EXPECT_NEAR(simplexAngle(radius, share * radius, height), angle, 1e-11) << radius << " " << share;
        last = height;
      }
      EXPECT_NEAR(simplexHeight(radius, share * radius, pi / 2), radius * std::sqrt(1 - share * share), 1e-12 * radius);
    }
}

TEST(SimplexGeometry, FallsBackToThePlaneWhereTheHeightIsAmbiguous)
{
  EXPECT_EQ(simplexHeight(1, 1, 0.5), 0);
  EXPECT_EQ(simplexHeight(1, 1.5, 0.5), 0);
  EXPECT_EQ(simplexHeight(1, 1.5, 3), 0);
  const SimplexNeighbours three{ Vec3{ 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 } };
  EXPECT_EQ(simplexPosition(three, { 1.5, -1, 0.5 }, 0.7).z, 0) << "the foot (1, -1, 0) is outside the circle";
}

TEST(SimplexGeometry, NeighboursOnALineGiveAFiniteShape)
{
  const SimplexShape shape = simplexShape({ 1, 1, 0 }, { Vec3{ 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } });
  EXPECT_EQ(shape.angle, 0);
  EXPECT_EQ(shape.height, 0);
  EXPECT_EQ(squaredNorm(shape.circle.normal), 0);
  EXPECT_TRUE(std::isfinite(shape.meanCurvature()));
}

TEST(SimplexGeometry, AngleOfCurvatureIsTheInverseOfMeanCurvature)
{
  for (const double radius : { 0.2, 3. })
    for (double angle = -3; angle < 3.1; angle += 0.1)
      EXPECT_NEAR(angleOfCurvature(std::sin(angle) / radius, radius, std::abs(angle) > pi / 2), angle, 1e-7);
  EXPECT_NEAR(angleOfCurvature(5, 1, false), pi / 2, 1e-15) << "more than a half sphere allows";
}

} // namespace surgicalmesher
