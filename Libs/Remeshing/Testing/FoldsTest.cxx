// SPDX-License-Identifier: Apache-2.0
#include "Folds.h"
#include "Bending.h"
#include "ComplexInvariants.h"
#include "FoldOpening.h"
#include "Groove.h"
#include "Triangle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surgicalmesher
{
namespace
{

using namespace test;

const SizingFunction unitScale = [](const Vec3&) { return 1.0f; };
constexpr double degree = 3.14159265358979323846 / 180;

std::vector<Hinge> hingesOf(TetComplex& complex)
{
  Hinges hinges;
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
    if (complex.onInterface[v]) hinges.add(complex, sheetOf(complex, v));
  return hinges.sorted();
}

/// Bounds of moves that samples limit one by one.
EnvelopeBounds wide(bool keepsFolds = false)
{
  EnvelopeBounds bounds;
  bounds.rmsLimit = 1;
  bounds.keepsFolds = keepsFolds;
  return bounds;
}

void openFolds(GuardedOperations& operations, double goodAngle)
{
  FoldOptions options;
  options.goodAngle = goodAngle;
  openFoldsOfBlock(operations, options);
}

double lengthOver90(TetComplex& complex)
{
  double sum = 0;
  for (const Hinge& h : hingesOf(complex))
    if (turnAt(complex, h) > 90 * degree) sum += lengthAt(complex, h);
  return sum;
}

bool isOnSeam(const Vec3& p) { return std::abs(p.x - 2.5) < 1e-9 && std::abs(p.z - 2.5) < 1e-9; }

TEST(Folds, AreWhereTheWallLeansOver)
{
  double seam = 0;
  TetComplex complex = groove(8);
  for (const Hinge& h : hingesOf(complex))
    if (std::abs(turnAt(complex, h) - 98 * degree) < 1e-9 && isOnSeam(complex.points[h[0]]))
      seam += lengthAt(complex, h);
  EXPECT_NEAR(seam, 6, 1e-9);
}

TEST(Folds, OfAMoveAreThoseAfterItLessThoseBefore)
{
  for (const double lean : { -12.0, 3.0, 8.0 })
  {
    TetComplex complex = groove(lean);
    for (const Vec3& way : { Vec3{ 0.3, 0.1, 0.2 }, Vec3{ -0.2, 0.1, -0.4 }, Vec3{ 0, 0, 0.9 } })
    {
      const std::int32_t v = vertexNear(complex, { 2.5, 2.5, 2.5 });
      const Sheet sheet = sheetOf(complex, v);
      Hinges around;
      around.add(complex, sheet);
      const auto sum = [&] { return foldedLength(complex, around.sorted()); };
      const Vec3 old = complex.points[v];
      const double more = foldedMore(complex, v, old + way, sheet), before = sum();
      complex.points[v] = old + way;
      EXPECT_NEAR(more, sum() - before, 1e-9) << lean;
      complex.points[v] = old;
    }
  }
}

TEST(FoldOpening, OpensAGrooveAndKeepsWhatEveryOperationKeeps)
{
  TetComplex complex = groove(8);
  const double before = lengthOver90(complex);
  constexpr double goodAngle = 20;
  GuardedOperations operations(complex, unitScale, wide());
  openFolds(operations, goodAngle);
  EXPECT_LT(lengthOver90(complex), 0.3 * before);
  EXPECT_TRUE(isConsistent(complex));
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    EXPECT_GE(operations.quality(t), sine2OfDegrees(goodAngle)) << t;
}

TEST(FoldOpening, LeavesWhatWouldTakeTooMuch)
{
  const TetComplex before = groove(45);
  TetComplex complex = before;
  GuardedOperations operations(complex, unitScale, wide());
  openFolds(operations, 5);
  EXPECT_EQ(operations.counts().moves, 0);
  EXPECT_TRUE(complex.points == before.points);
}

/// However little samples and angles allow: what has moved for too little goes back.
TEST(FoldOpening, MovesNothingForLittle)
{
  const auto folded = [](TetComplex& complex) { return foldedLength(complex, hingesOf(complex)); };
  constexpr double leastGain = 0.25; // of edges of length 1
  for (double rmsLimit = 0.005; rmsLimit < 0.2; rmsLimit *= 1.3)
    for (const double lean : { 1.0, 2.0, 8.0 })
    {
      TetComplex complex = groove(lean);
      const std::int32_t onlyFree = vertexNear(complex, { 2.5, 2.5, 2.5 });
      for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v) complex.locked[v] = v != onlyFree;
      const std::vector<Vec3> points = complex.points;
      const double before = folded(complex);
      EnvelopeBounds bounds = wide();
      bounds.rmsLimit = rmsLimit;
      GuardedOperations operations(complex, unitScale, bounds);
      openFolds(operations, 20);
      EXPECT_TRUE(isConsistent(complex));
      EXPECT_TRUE(complex.points == points || folded(complex) < before - leastGain) << rmsLimit << ", " << lean;
    }
}

/// Whether every distance of a sample that is known is that to the face which has it.
bool distancesAreTrue(const TetComplex& complex)
{
  for (std::size_t t = 0; t < complex.tets.size(); ++t)
    for (int i = 0; i < 4; ++i)
      for (std::int32_t e = complex.sampleHeads[t][i]; e >= 0; e = complex.samples[e].next)
      {
        const auto corner = [&](int k) { return complex.points[complex.tets[t][(i + k) & 3]]; };
        const ListedSample& sample = complex.samples[e];
        const double now = squaredDistanceToTriangle(sample.position, corner(1), corner(2), corner(3));
        if (sample.distance2 >= 0 && std::abs(sample.distance2 - now) > 1e-9) return false;
      }
  return true;
}

TEST(GuardedOperations, FoldNothingWhereFoldsAreKept)
{
  for (const bool keepsFolds : { false, true })
  {
    TetComplex complex = groove(-8);
    const std::int32_t v = vertexNear(complex, { 2.5, 2.5, 2.5 }); // of the seam, where normals turn by 82 degrees
    const Vec3 deeper = complex.points[v] - Vec3{ 0, 0, 0.3 }, shallower = complex.points[v] + Vec3{ 0, 0, 0.1 };
    GuardedOperations operations(complex, unitScale, wide(keepsFolds));
    EXPECT_EQ(operations.move(v, deeper, 1e-8), !keepsFolds);
    EXPECT_TRUE(distancesAreTrue(complex)) << "what is refused hands no sample on";
    EXPECT_TRUE(operations.move(v, shallower, 1e-8));
  }
}

} // namespace
} // namespace surgicalmesher
