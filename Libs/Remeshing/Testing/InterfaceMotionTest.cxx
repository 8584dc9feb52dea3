// SPDX-License-Identifier: Apache-2.0
#include "InterfaceMotion.h"
#include "ComplexInvariants.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

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

InterfaceMotionOptions reaching(double farthest, double leastAngle, int steps)
{
  InterfaceMotionOptions options;
  options.farthest = farthest;
  options.leastAngle = leastAngle;
  options.steps = steps;
  return options;
}

void move(TetComplex& complex, const InterfaceMotionOptions& options)
{
  const SizingFunction length = [](const Vec3&) { return 1.0; };
  EnvelopeBounds bounds;
  bounds.rmsLimit = 1;
  GuardedOperations operations(complex, length, bounds);
  moveInterfaceOfBlock(operations, options);
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

TEST(InterfaceMotion, TakesStepsAwayAndKeepsTheVolume)
{
  TetComplex complex = voxelsOf(ball);
  const double before = volumesOf(meshOf(complex)).at(1), rough = roughness(complex);
  move(complex, reaching(0.5, 5, 20));
  EXPECT_LT(roughness(complex), 0.7 * rough);
  EXPECT_NEAR(volumesOf(meshOf(complex)).at(1), before, 0.02 * before);
}

TEST(InterfaceMotion, InternalForcesAloneTakeStepsAwayButThoseOfC0)
{
  std::map<Continuity, double> rough;
  for (const Continuity continuity : { Continuity::C0, Continuity::C1, Continuity::C2 })
  {
    TetComplex complex = voxelsOf(ball);
    InterfaceMotionOptions options = reaching(0.5, 5, 20);
    options.motion.hidden = options.motion.image = 0;
    options.motion.internalForce.continuity = continuity;
    move(complex, options);
    rough[continuity] = roughness(complex);
  }
  const double before = roughness(voxelsOf(ball));
  EXPECT_LT(rough[Continuity::C1], 0.9 * before);
  EXPECT_LT(rough[Continuity::C2], 0.9 * before);
  EXPECT_GT(rough[Continuity::C0], 1.1 * std::max(rough[Continuity::C1], rough[Continuity::C2]));
}

TEST(InterfaceMotion, TheImageForceLeadsToTheSamples)
{
  TetComplex complex = voxelsOf([](int, int, int k) { return k < 6 ? 1 : 2; });
  for (auto& sample : complex.samples) sample.position.z += 0.1;
  InterfaceMotionOptions options = reaching(0.3, 5, 20);
  options.motion.image = 0.5;
  move(complex, options);
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < complex.points.size(); ++v)
    if (const Vec3 off = complex.points[v] - Vec3{ 5.5, 5.5, 5.5 };
        complex.onInterface[v] && std::abs(off.x) < 3 && std::abs(off.y) < 3 && std::abs(off.z) < 1)
      sum += off.z, ++count;
  EXPECT_GT(sum / count, 0.03); // the balance of volumes takes part of it back
}

TEST(InterfaceMotion, StraightensCurvesBetweenTissues)
{
  // Two tissues on a flat floor, parted by a wall of steps: the curve of all three winds.
  const auto steps = [](int i, int j, int k) { return k < 3 ? 0 : i + (j / 2) % 2 < 6 ? 1 : 2; };
  TetComplex complex = voxelsOf(steps);
  const auto width = [&]
  {
    double least = 1e9, most = 0;
    for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
    {
      const Vec3& p = complex.points[v];
      if (!complex.onInterface[v] || complex.locked[v] || std::abs(p.y - 5.5) > 3) continue;
      std::set<Label> labels;
      std::vector<std::int32_t> star;
      complex.star(v, star);
      for (const std::int32_t t : star) labels.insert(complex.labels[t]);
      if (labels.size() == 3 && p.z < 6) least = std::min(least, p.x), most = std::max(most, p.x);
    }
    return most - least;
  };
  const double before = width();
  move(complex, reaching(0.4, 5, 10));
  EXPECT_LT(width(), 0.9 * before);
}

TEST(InterfaceMotion, LeavesACurveWhereItIsThatGoesOnToWhereNothingMoves)
{
  // Two tissues on a floor, parted by a flat wall; elements are coarse in half of the map.
  TetComplex complex = voxelsOf([](int, int j, int k) { return k < 6 ? 0 : j < 6 ? 1 : 2; });
  for (std::size_t v = 0; v < complex.points.size(); ++v)
    if (complex.points[v].x > 6) complex.lengths[v] = 9;
  const std::vector<Vec3> start = complex.points;
  InterfaceMotionOptions options = reaching(2, 5, 6);
  options.fineLength = 2;
  move(complex, options);
  for (std::size_t v = 0; v < start.size(); ++v)
    if (start[v].y == 5.5 && start[v].z == 5.5 && std::abs(start[v].x - 5.5) < 3)
    {
      EXPECT_LT(norm(complex.points[v] - start[v]), 0.02);
    }
}

TEST(InterfaceMotion, LeavesAPlaneWhereItIs)
{
  TetComplex complex = voxelsOf([](int, int, int k) { return k < 6 ? 1 : 2; });
  const std::vector<Vec3> start = complex.points;
  move(complex, reaching(0.3, 15, 1)); // two rings of neighbours tell
  for (std::size_t v = 0; v < start.size(); ++v)
  {
    const Vec3 off = start[v] - Vec3{ 5.5, 5.5, 5.5 };
    if (complex.onInterface[v] && std::abs(off.x) < 3 && std::abs(off.y) < 3 && std::abs(off.z) < 1)
    {
      EXPECT_NEAR(complex.points[v].z, 5.5, 0.02); // the corners' volume comes back evenly
    }
  }
}

TEST(InterfaceMotion, KeepsWithinReachAndAboveTheLeastAngle)
{
  for (const double reach : { 0.05, 0.2 })
  {
    TetComplex complex = voxelsOf(halves);
    const std::vector<Vec3> start = complex.points;
    move(complex, reaching(reach, 20, 6));
    double most = 0;
    for (std::size_t v = 0; v < start.size(); ++v) most = std::max(most, norm(complex.points[v] - start[v]));
    EXPECT_LE(most, reach * (1 + 1e-9));
    EXPECT_GT(most, 0.5 * reach);
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
      EXPECT_GE(complex.quality(t), sine2OfDegrees(20) * (1 - 1e-9));
  }
}

TEST(InterfaceMotion, ReachesLessWhereElementsAreCoarse)
{
  TetComplex complex = voxelsOf(ball);
  const std::vector<Vec3> start = complex.points;
  InterfaceMotionOptions options;
  options.farthest = 0.4;
  options.fineLength = 0.5; // L is 1
  move(complex, options);
  for (std::size_t v = 0; v < start.size(); ++v)
    EXPECT_LE(norm(complex.points[v] - start[v]), 0.4 * std::pow(0.5, 1.5) * (1 + 1e-6));
}

} // namespace
} // namespace surgicalmesher
