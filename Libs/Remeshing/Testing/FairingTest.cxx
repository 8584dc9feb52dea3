// SPDX-License-Identifier: Apache-2.0
#include "Fairing.h"
#include "ComplexInvariants.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <functional>

namespace surgicalmesher
{
namespace
{

using namespace test;

/// Steps of voxels all over: tolerances are wide.
TetComplex voxelsOf(const std::function<int(int i, int j, int k)>& paint)
{
  return complexOf(tetrahedraOf(paintedMap({ 12, 12, 12 }, paint)), 1, 1);
}

FairingOptions reaching(double farthest, double leastAngle, int rounds)
{
  FairingOptions options;
  options.farthest = farthest;
  options.leastAngle = leastAngle;
  options.rounds = rounds;
  return options;
}

void fair(TetComplex& complex, const FairingOptions& options)
{
  const SizingFunction length = [](const Vec3&) { return 1.0; };
  EnvelopeBounds bounds;
  bounds.rmsLimit = 1;
  GuardedOperations operations(complex, length, bounds);
  fairBlock(operations, options);
}

const auto ball = [](int i, int j, int k) {
  return squaredNorm(Vec3{ double(i), double(j), double(k) } - Vec3{ 5.5, 5.5, 5.5 }) < 20 ? 1 : 0;
};
const auto halves = [](int i, int j, int k) { return ball(i, j, k) * (i + j < 11 ? 1 : 2); };

/// By how much the distances of the interface from the middle of the map differ.
double roughness(const TetComplex& complex)
{
  double least = 1e9, most = 0;
  for (std::size_t v = 0; v < complex.points.size(); ++v)
  {
    if (!complex.onInterface[v]) continue;
    const double r = norm(complex.points[v] - Vec3{ 5.5, 5.5, 5.5 });
    least = std::min(least, r);
    most = std::max(most, r);
  }
  return most - least;
}

TEST(Fairing, TakesStepsAwayAndKeepsTheVolume)
{
  TetComplex complex = voxelsOf(ball);
  const double before = volumesOf(meshOf(complex)).at(1), rough = roughness(complex);
  fair(complex, reaching(0.5, 5, 20));
  EXPECT_LT(roughness(complex), 0.7 * rough);
  EXPECT_NEAR(volumesOf(meshOf(complex)).at(1), before, 0.02 * before);
}

TEST(Fairing, LeavesAPlaneWhereItIs)
{
  TetComplex complex = voxelsOf([](int, int, int k) { return k < 6 ? 1 : 2; });
  const std::vector<Vec3> start = complex.points;
  fair(complex, reaching(0.3, 15, 1)); // two rings of neighbours tell
  for (std::size_t v = 0; v < start.size(); ++v)
  {
    const Vec3 off = start[v] - Vec3{ 5.5, 5.5, 5.5 };
    if (complex.onInterface[v] && std::abs(off.x) < 3 && std::abs(off.y) < 3 && std::abs(off.z) < 1)
    {
      EXPECT_NEAR(complex.points[v].z, 5.5, 0.02); // the corners' volume comes back evenly
    }
  }
}

TEST(Fairing, KeepsWithinReachAndAboveTheLeastAngle)
{
  for (const double reach : { 0.05, 0.2 })
  {
    TetComplex complex = voxelsOf(halves);
    const std::vector<Vec3> start = complex.points;
    fair(complex, reaching(reach, 20, 6));
    double most = 0;
    for (std::size_t v = 0; v < start.size(); ++v) most = std::max(most, norm(complex.points[v] - start[v]));
    EXPECT_LE(most, reach * (1 + 1e-9));
    EXPECT_GT(most, 0.5 * reach);
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
      EXPECT_GE(complex.quality(t), sine2OfDegrees(20) * (1 - 1e-9));
  }
}

TEST(Fairing, ReachesLessWhereElementsAreCoarse)
{
  TetComplex complex = voxelsOf(ball);
  const std::vector<Vec3> start = complex.points;
  FairingOptions options;
  options.farthest = 0.4;
  options.fineLength = 0.5; // L is 1
  fair(complex, options);
  for (std::size_t v = 0; v < start.size(); ++v) EXPECT_LE(norm(complex.points[v] - start[v]), 0.1 * (1 + 1e-9));
}

} // namespace
} // namespace surgicalmesher
