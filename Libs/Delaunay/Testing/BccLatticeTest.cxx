// SPDX-License-Identifier: Apache-2.0
#include "BccLattice.h"
#include "Errors.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

constexpr double kRadius = 10;

std::vector<Vec3> inside(const std::vector<Vec3>& points, double radius)
{
  std::vector<Vec3> result;
  std::copy_if(points.begin(), points.end(), std::back_inserter(result),
               [&](const Vec3& p) { return norm(p) < radius; });
  return result;
}

double nearestOther(const std::vector<Vec3>& points, std::size_t i)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < points.size(); ++j)
  {
    if (j != i) nearest = std::min(nearest, norm(points[j] - points[i]));
  }
  return nearest;
}

TEST(LatticePoints, KeepClearOfTheSurface)
{
  const SurfaceComplex surface = test::sphere({}, kRadius, 4);
  const double length = 1.5, sagitta = 0.1;
  const std::vector<Vec3> points = latticePoints(
    surface, [=](const Vec3&) { return length; }, 0.6);
  double closest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) closest = std::min(closest, std::abs(norm(p) - kRadius));
  EXPECT_GE(closest, 0.6 * length - sagitta);
  EXPECT_LE(closest, 0.8 * length) << "and not further than needed";
}

TEST(LatticePoints, FillTheInsideAtTheDensityAskedFor)
{
  const SurfaceComplex surface = test::sphere({}, kRadius, 3);
  for (const double length : { 0.7, 0.9, 1.3 })
  {
    const std::vector<Vec3> points = inside(latticePoints(surface, [=](const Vec3&) { return length; }), 7);
    const double cube = length / kLatticeMeanEdge;
    const double expected = 4.0 / 3 * M_PI * 7 * 7 * 7 * 2 / (cube * cube * cube);
    EXPECT_NEAR(double(points.size()), expected, 0.1 * expected) << length;
    for (std::size_t i = 0; i < points.size(); i += 7)
      EXPECT_NEAR(nearestOther(points, i), std::sqrt(0.75) * cube, 1e-9);
  }
}

TEST(LatticePoints, FollowTheGradedLength)
{
  const SurfaceComplex surface = test::sphere({}, kRadius, 4);
  const auto length = [](const Vec3& p) { return 0.5 + 0.25 * norm(p); };
  const std::vector<Vec3> points = inside(latticePoints(surface, length), 8);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double ratio = nearestOther(points, i) / length(points[i]);
    EXPECT_GT(ratio, 0.3);
    EXPECT_LT(ratio, 1.8);
  }
}

TEST(LatticePoints, HaveTheNearestOctave)
{
  const SurfaceComplex surface = test::sphere({}, kRadius, 4);
  for (const double least : { 0.4, 0.5, 0.6 })
  {
    const auto length = [=](const Vec3& p) { return least + 0.12 * norm(p); };
    const std::vector<Vec3> points = inside(latticePoints(surface, length), 8);
    std::size_t tested = 0, near = 0;
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); i += 7)
    {
      const double meanEdge = nearestOther(points, i) / std::sqrt(0.75) * kLatticeMeanEdge;
      const double octaves = std::log2(meanEdge / length(points[i]));
      ++tested;
      near += std::abs(octaves) < 0.6;
      sum += octaves;
    }
    ASSERT_GT(tested, 100u);
    EXPECT_GT(double(near), 0.9 * double(tested)) << least;
    EXPECT_NEAR(sum / double(tested), 0, 0.3) << "neither too fine nor too coarse on the whole, " << least;
  }
}

TEST(LatticePoints, FitTheLengthOfMostOfTheTissue)
{
  const SurfaceComplex surface = test::sphere({}, kRadius, 4);
  const auto length = [](const Vec3& p) { return p.x < 1 ? 1.0 : 1.4; };
  const std::vector<Vec3> points = latticePoints(surface, length);
  std::size_t tested = 0;
  for (std::size_t i = 0; i < points.size(); i += 7)
  {
    if (points[i].x > -2 || norm(points[i]) > 8) continue;
    ++tested;
    EXPECT_NEAR(nearestOther(points, i) / std::sqrt(0.75) * kLatticeMeanEdge, 1, 0.03) << "a little is off the lattice";
  }
  EXPECT_GT(tested, 50u);
}

TEST(LatticePoints, FitTheLengthOfMostVerticesRatherThanMostOfTheVolume)
{
  const SurfaceComplex surface = test::sphere({}, kRadius, 4);
  const auto length = [](const Vec3& p) { return p.x > 3 ? 1.0 : 1.6; }; // 28 % of the volume, 61 % of the vertices
  const std::vector<Vec3> points = latticePoints(surface, length);
  std::size_t tested = 0;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    if (points[i].x < 5 || norm(points[i]) > 8) continue;
    ++tested;
    EXPECT_NEAR(nearestOther(points, i) / std::sqrt(0.75) * kLatticeMeanEdge, 1, 0.03);
  }
  EXPECT_GT(tested, 50u);
}

TEST(LatticePoints, GrowSparseOutside)
{
  const SurfaceComplex surface = test::sphere({}, kRadius, 3);
  const std::vector<Vec3> points = latticePoints(surface, [](const Vec3&) { return 1.0; });
  const std::size_t within = inside(points, kRadius).size();
  EXPECT_GT(points.size(), within) << "there is a box around";
  EXPECT_LT(points.size(), 2 * within);
}

TEST(LatticePoints, SurfacesDoNotFillCavities)
{
  SurfaceComplex shell = test::sphere({}, kRadius, 4, 1, 0);
  test::append(shell, test::sphere({}, 6, 3, 0, 1));
  for (auto& [behind, front] : shell.labels) EXPECT_NE(behind, front);
  const auto one = [](const Vec3&) { return 1.0; };
  const std::size_t hollow = inside(latticePoints(shell, one), 5).size();
  const std::size_t solid = inside(latticePoints(test::sphere({}, kRadius, 4), one), 5).size();
  EXPECT_LT(hollow, solid / 2) << "outside is sparse, in a cavity as well";
}

TEST(LatticePoints, DoNotDependOnThreads)
{
  const SurfaceComplex surface = test::torus(8, 3, 24, 12);
  const auto length = [](const Vec3& p) { return 0.5 + 0.1 * norm(p); };
  vtkSMPTools::Initialize(1);
  const std::vector<Vec3> one = latticePoints(surface, length);
  vtkSMPTools::Initialize(3);
  const std::vector<Vec3> three = latticePoints(surface, length);
  vtkSMPTools::Initialize(0);
  ASSERT_EQ(one.size(), three.size());
  EXPECT_TRUE(std::equal(one.begin(), one.end(), three.begin()));
}

TEST(LatticePoints, RefuseLengthsThatAreNone)
{
  const SurfaceComplex surface = test::sphere({}, kRadius, 1);
  for (const double length : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    EXPECT_THROW(latticePoints(surface, [=](const Vec3&) { return length; }), InputError) << length;
  }
  EXPECT_TRUE(latticePoints({}, [](const Vec3&) { return 1.0; }).empty());
}

} // namespace
} // namespace surgicalmesher
