// SPDX-License-Identifier: Apache-2.0
#include "VertexPlacement.h"
#include "BccLattice.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <vtkSMPTools.h>

#include <algorithm>
#include <limits>
#include <random>

namespace surgicalmesher
{
namespace
{

constexpr double kRadius = 10, kClearance = 0.4;

const SizingFunction uniform = [](const Vec3&) { return 1.5; };
const SizingFunction graded = [](const Vec3& p) { return 1 + 0.15 * std::max(0.0, p.z + kRadius); };

/// Vertices about as far apart as L.
const SurfaceComplex& ball()
{
  static const SurfaceComplex surface = test::sphere({}, kRadius, 3);
  return surface;
}

std::vector<Vec3> insideOf(const std::vector<Vec3>& points)
{
  std::vector<Vec3> result;
  std::copy_if(points.begin(), points.end(), std::back_inserter(result),
               [](const Vec3& p) { return norm(p) < kRadius; });
  return result;
}

double nearestTo(const std::vector<Vec3>& points, const Vec3& p)
{
  double nearest = std::numeric_limits<double>::max();
  for (const Vec3& q : points)
    if (!(q == p)) nearest = std::min(nearest, norm(q - p));
  return nearest;
}

std::vector<Vec3> together(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
  std::vector<Vec3> result = a;
  result.insert(result.end(), b.begin(), b.end());
  return result;
}

std::vector<Vec3> shaken(std::vector<Vec3> points, double distance)
{
  std::mt19937 random(5);
  const auto next = [&] { return distance * (double(random()) / 2147483648.0 - 1); };
  for (Vec3& p : points)
    if (norm(p) < kRadius - 2) p += Vec3{ next(), next(), next() };
  return points;
}

} // namespace

TEST(VertexPlacement, LeavesTheLatticeAloneUnlessAsked)
{
  const std::vector<Vec3> points = latticePoints(ball(), graded, kClearance);
  EXPECT_EQ(placedPoints(ball(), points, graded, VertexPlacement::Lattice, kClearance), points);
}

TEST(VertexPlacement, LowersThePenaltyAndKeepsClear)
{
  for (const VertexPlacement placement : { VertexPlacement::NotWhole, VertexPlacement::All })
    for (const SizingFunction& length : { uniform, graded })
    {
      const std::vector<Vec3> before = shaken(latticePoints(ball(), length, kClearance), 0.4);
      const std::vector<Vec3> after = placedPoints(ball(), before, length, placement, kClearance);
      const auto penaltyOf = [&](const std::vector<Vec3>& points) // for each, as some come and go
      { return placementPenalty(together(ball().points, insideOf(points)), length) / double(insideOf(points).size()); };
      EXPECT_LT(penaltyOf(after), penaltyOf(before));
      const double sagitta = 0.15;
      for (const Vec3& p : insideOf(after)) EXPECT_GE(kRadius - norm(p), kClearance * length(p) - sagitta);
    }
}

TEST(VertexPlacement, HoldsWhatIsWhole)
{
  const std::vector<Vec3> before = latticePoints(ball(), uniform, kClearance);
  const std::vector<Vec3> after = placedPoints(ball(), before, uniform, VertexPlacement::NotWhole, kClearance);
  const std::vector<Vec3> all = placedPoints(ball(), before, uniform, VertexPlacement::All, kClearance);
  const auto has = [](const std::vector<Vec3>& points, const Vec3& p)
  { return std::find(points.begin(), points.end(), p) != points.end(); };
  std::size_t moved = 0, movedByAll = 0;
  for (const Vec3& p : insideOf(before))
  {
    if (norm(p) < kRadius - 3 * 1.5)
    {
      EXPECT_TRUE(has(after, p));
    }
    moved += !has(after, p);
    movedByAll += !has(all, p);
  }
  EXPECT_GT(moved, 0u);
  EXPECT_GT(movedByAll, 2 * moved);
}

TEST(VertexPlacement, PutsOneIntoAHoleAndTakesOneFromAPair)
{
  std::vector<Vec3> points = latticePoints(ball(), uniform, kClearance);
  const auto isInHole = [](const Vec3& p) { return norm(p) < 2.2; };
  const std::size_t full = points.size();
  points.erase(std::remove_if(points.begin(), points.end(), isInHole), points.end());
  ASSERT_LT(points.size(), full - 10);
  const std::vector<Vec3> filled = placedPoints(ball(), points, uniform, VertexPlacement::All, kClearance);
  EXPECT_TRUE(std::any_of(filled.begin(), filled.end(), isInHole));

  std::vector<Vec3> pairs = latticePoints(ball(), uniform, kClearance);
  const std::vector<Vec3> inside = insideOf(pairs);
  for (const Vec3& p : inside)
    if (norm(p) < 6) pairs.push_back(p + Vec3{ 0.05, 0.02, 0.01 });
  const std::vector<Vec3> thinned = placedPoints(ball(), pairs, uniform, VertexPlacement::All, kClearance);
  EXPECT_LT(thinned.size(), pairs.size());
  for (const Vec3& p : insideOf(thinned)) EXPECT_GE(nearestTo(thinned, p), 0.5 * 1.5);
}

TEST(VertexPlacement, DoesNotDependOnThreads)
{
  const std::vector<Vec3> points = latticePoints(ball(), graded, kClearance);
  vtkSMPTools::Initialize(1);
  const std::vector<Vec3> one = placedPoints(ball(), points, graded, VertexPlacement::All, kClearance);
  vtkSMPTools::Initialize(3);
  const std::vector<Vec3> three = placedPoints(ball(), points, graded, VertexPlacement::All, kClearance);
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(one, three);
}

} // namespace surgicalmesher
