// SPDX-License-Identifier: Apache-2.0
#include "Schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace surgicalmesher
{
namespace
{

constexpr MeshSizes sizes{ 1, 8, std::numeric_limits<double>::infinity() };

/// The kinds of the passes of all sweeps, in their order.
std::vector<std::size_t> passesOf(const std::vector<Sweep>& sweeps)
{
  std::vector<std::size_t> kinds;
  for (const Sweep& sweep : sweeps)
    for (const Stage& stage : sweep.stages)
      for (const Pass& pass : stage.passes) kinds.push_back(pass.index());
  return kinds;
}

TEST(Schedule, DoesForNoisyMapsWhatItDoesForOthersButRepairs)
{
  EXPECT_EQ(passesOf({ firstImprovement(noisyTargets, sizes) }), passesOf({ firstImprovement(usualTargets, sizes) }));
  EXPECT_EQ(passesOf({ fittingSweep(noisyTargets, sizes) }), passesOf({ fittingSweep(usualTargets, sizes) }));
  EXPECT_EQ(passesOf(secondRepairSweeps(noisyTargets, sizes)), passesOf(secondRepairSweeps(usualTargets, sizes)));
}

const CoarseningOptions& coarseningOf(const Sweep& sweep)
{
  return std::get<Coarsen>(sweep.stages.front().passes.front()).options;
}

/// Of the improvement in the first stage of a sweep, degrees.
double aimOf(const Sweep& sweep)
{
  double aim = 0;
  for (const Pass& pass : sweep.stages.front().passes)
    if (const auto* improve = std::get_if<Improve>(&pass)) aim = improve->options.targetAngle;
  return aim;
}

TEST(Schedule, DoesOneLevelLaterWhatLevelsDoWhereLIsManyVoxels)
{
  const MeshSizes longer{ 1, 30, sizes.maximumDistance };
  const std::vector<double> levels = sizeLevels(longer);
  ASSERT_GT(levels.size(), 6U);
  for (std::size_t n = 1; n < 6; ++n)
  {
    const Sweep usual = coarsenTo(levels[n - 1], sizes), later = coarsenTo(levels[n], longer);
    EXPECT_EQ(passesOf({ later }), passesOf({ usual })) << n;
    EXPECT_EQ(coarseningOf(later).fit, coarseningOf(usual).fit) << n;
    EXPECT_EQ(coarseningOf(later).thorough, coarseningOf(usual).thorough) << n;
    EXPECT_EQ(isCoarse(levels[n], longer), isCoarse(levels[n - 1], sizes)) << n;
  }
  EXPECT_FALSE(isCoarse(levels[0], longer));
  EXPECT_TRUE(isCoarse(levels[4], longer)) << "as far as that alone";
}

TEST(Schedule, RepairsNoisyMapsMoreThoroughly)
{
  const std::vector<Sweep> noisy = repairSweeps(noisyTargets, sizes), usual = repairSweeps(usualTargets, sizes);
  EXPECT_GT(noisy.size(), usual.size());
  EXPECT_TRUE(noisy.back().whole);
  EXPECT_FALSE(usual.back().whole);
}

TEST(Schedule, AimsHigherFromSweepToSweepUpToTheRepairs)
{
  for (const MeshTargets& targets : { usualTargets, noisyTargets })
  {
    std::vector<Sweep> sweeps{ firstImprovement(targets, sizes) };
    const std::vector<Sweep> more = improvementSweeps(targets, sizes);
    sweeps.insert(sweeps.end(), more.begin(), more.end());
    sweeps.push_back(repairSweeps(targets, sizes).front());
    EXPECT_EQ(aimOf(sweeps.front()), targets.firstAngle);
    EXPECT_EQ(aimOf(sweeps.back()), targets.aimedAngle);
    for (std::size_t n = 1; n < sweeps.size(); ++n) EXPECT_GT(aimOf(sweeps[n]), aimOf(sweeps[n - 1])) << n;
  }
}

TEST(Schedule, CountsTrianglesInEveryRepair)
{
  for (const MeshTargets& targets : { usualTargets, noisyTargets })
    for (const Sweep& sweep : repairSweeps(targets, sizes)) EXPECT_GT(sweep.stages.back().bounds.triangleWeight, 1);
}

TEST(Schedule, TakesTheWholeMeshApartOnceForAllThatFollowsOneAnother)
{
  for (const auto& sweeps : { sweepsForRawMesh(28.5, 1), sweepsForImprovedMesh(28.5, 1), sweepsForCurves(28.5, 1) })
  {
    EXPECT_TRUE(sweeps.back().sweep.whole);
    for (std::size_t n = 1; n < sweeps.size(); ++n)
      EXPECT_FALSE(sweeps[n - 1].sweep.whole && sweeps[n].sweep.whole) << n;
  }
}

TEST(Schedule, LeavesCrowdsOnlyToStagesWithWiderBounds)
{
  for (const auto& sweeps : { sweepsForRawMesh(28.5, 1), sweepsForImprovedMesh(28.5, 1), sweepsForCurves(28.5, 1) })
  {
    std::vector<std::pair<double, double>> improvements; // tolerance, crowd
    for (const TetrahedralSweep& each : sweeps)
      for (const Stage& stage : each.sweep.stages)
        for (const Pass& pass : stage.passes)
          if (const auto* improve = std::get_if<Improve>(&pass); improve && each.sweep.whole)
            improvements.emplace_back(stage.bounds.toleranceFactor, improve->options.crowd);
    const auto leaves = [](const auto& improvement) { return improvement.second < 1; };
    EXPECT_TRUE(std::any_of(improvements.begin(), improvements.end(), leaves));
    for (std::size_t n = 0; n < improvements.size(); ++n)
      if (leaves(improvements[n]))
      {
        ASSERT_LT(n + 1, improvements.size());
        EXPECT_GT(improvements[n + 1].first, improvements[n].first) << n;
      }
  }
}

} // namespace
} // namespace surgicalmesher
