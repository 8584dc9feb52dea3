// SPDX-License-Identifier: Apache-2.0
#include "Distance.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace surgicalmesher;

namespace
{

class Random
{
public:
  explicit Random(unsigned int seed) : m_Engine(seed) {}
  Vec3 point() { return { m_Coordinate(m_Engine), m_Coordinate(m_Engine), m_Coordinate(m_Engine) }; }
  Path path(int points)
  {
    Path path;
    for (int n = 0; n < points; ++n) path.push_back(point());
    return path;
  }

private:
  std::mt19937 m_Engine;
  std::uniform_real_distribution<double> m_Coordinate{ -50, 50 };
};

/// The least of measure(p, share of arc length) over finely spaced points of the path; off by at most the spacing.
template <typename Measure>
double leastAlong(const Path& path, Measure measure)
{
  constexpr int steps = 2000;
  double least = std::numeric_limits<double>::infinity();
  double arc = 0;
  for (std::size_t n = 1; n < path.size(); ++n)
  {
    const double length = norm(path[n] - path[n - 1]);
    for (int s = 0; s <= steps; ++s)
    {
      const double u = double(s) / steps;
      least =
        std::min(least, measure(path[n - 1] + u * (path[n] - path[n - 1]), (arc + u * length) / pathLength(path)));
    }
    arc += length;
  }
  return least;
}

} // namespace

TEST(Distance, ToPointsIsThatToTheNearest)
{
  Random random(1);
  const std::vector<Vec3> points = random.path(9);
  for (int n = 0; n < 100; ++n)
  {
    const Vec3 x = random.point();
    double nearest = 1e9;
    for (const Vec3& point : points) nearest = std::min(nearest, norm(x - point));
    EXPECT_DOUBLE_EQ(distanceToPoints(x, points), nearest);
  }
  EXPECT_EQ(distanceToPoints({ 1, 2, 3 }, {}), std::numeric_limits<double>::infinity());
}

TEST(Distance, ToPathsAgreesWithDenseSampling)
{
  Random random(2);
  const std::vector<Path> paths{ random.path(2), random.path(7) };
  for (int n = 0; n < 100; ++n)
  {
    const Vec3 x = random.point();
    const auto distance = [&](const Vec3& p, double) { return norm(x - p); };
    const double sampled = std::min(leastAlong(paths[0], distance), leastAlong(paths[1], distance));
    EXPECT_LE(distanceToPaths(x, paths), sampled + 1e-9);
    EXPECT_NEAR(distanceToPaths(x, paths), sampled, 0.1);
  }
  EXPECT_EQ(distanceToPaths({ 1, 2, 3 }, {}), std::numeric_limits<double>::infinity());
}

TEST(Distance, ToSegmentKnowsInsideEndsAndPoints)
{
  const Vec3 a{ 0, 0, 0 };
  const Vec3 b{ 10, 0, 0 };
  EXPECT_DOUBLE_EQ(distanceToSegment({ 5, 3, 4 }, a, b), 5);
  EXPECT_DOUBLE_EQ(distanceToSegment({ -3, 4, 0 }, a, b), 5);
  EXPECT_DOUBLE_EQ(distanceToSegment({ 13, 0, 4 }, a, b), 5);
  EXPECT_DOUBLE_EQ(distanceToSegment({ 0, 3, 4 }, a, a), 5);
}

TEST(Distance, ToTubeAgreesWithDenseSampling)
{
  Random random(3);
  for (const auto& [atEntry, atTarget] :
       { std::pair(25.0, 5.0), std::pair(5.0, 25.0), std::pair(8.0, 8.0), std::pair(300.0, 1.0) })
  {
    const Path path = random.path(5);
    for (int n = 0; n < 50; ++n)
    {
      const Vec3 x = random.point();
      const double from = atEntry;
      const double to = atTarget;
      const double sampled =
        leastAlong(path, [&](const Vec3& p, double share) { return norm(x - p) - (from + share * (to - from)); });
      EXPECT_LE(distanceToTube(x, path, from, to), sampled + 1e-9);
      EXPECT_NEAR(distanceToTube(x, path, from, to), sampled, 0.2);
    }
  }
}

TEST(Distance, ToTubeSurvivesRepeatedPoints)
{
  const Path path{ { 0, 0, 0 }, { 0, 0, 0 }, { 10, 0, 0 }, { 10, 0, 0 } };
  EXPECT_NEAR(distanceToTube({ 0, 7, 0 }, path, 2, 2), 5, 1e-12);
  EXPECT_NEAR(distanceToTube({ 0, 7, 0 }, { { 0, 0, 0 }, { 0, 0, 0 } }, 2, 2), 5, 1e-12);
}
