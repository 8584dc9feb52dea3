// SPDX-License-Identifier: Apache-2.0
#include "Schedule.h"

#include <gtest/gtest.h>

#include <limits>

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

TEST(Schedule, DoesForNoisyMapsWhatItDoesForOthers)
{
  EXPECT_EQ(passesOf({ firstImprovement(noisyTargets, sizes) }), passesOf({ firstImprovement(usualTargets, sizes) }));
  EXPECT_EQ(passesOf(repairSweeps(noisyTargets, sizes)), passesOf(repairSweeps(usualTargets, sizes)));
  EXPECT_EQ(passesOf({ fittingSweep(noisyTargets, sizes) }), passesOf({ fittingSweep(usualTargets, sizes) }));
  EXPECT_EQ(passesOf(secondRepairSweeps(noisyTargets, sizes)), passesOf(secondRepairSweeps(usualTargets, sizes)));
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

} // namespace
} // namespace surgicalmesher
