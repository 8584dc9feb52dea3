// SPDX-License-Identifier: Apache-2.0
#include "ProximitySplits.h"
#include "ComplexInvariants.h"
#include "MeshChecks.h"
#include "Triangle.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

namespace surgicalmesher
{
namespace
{

using namespace test;

constexpr float tolerance = 0.2f;

TetComplex floorOfVoxels()
{
  return complexOf(tetrahedraOf(paintedMap({ 12, 12, 12 }, [](int, int, int k) { return k < 6 ? 1 : 2; })), 1,
                   tolerance);
}

/// The largest distance of a sample to its face.
double farthest(const TetComplex& c)
{
  double most = 0;
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
    for (int i = 0; c.alive(t) && i < 4; ++i)
      for (std::int32_t e = c.sampleHeads[t][i]; e >= 0; e = c.samples[e].next)
      {
        const auto& x = c.tets[t];
        const auto at = [&](int k) { return c.points[x[(i + k) & 3]]; };
        most = std::max(most, std::sqrt(squaredDistanceToTriangle(c.samples[e].position, at(1), at(2), at(3))));
      }
  return most;
}

OperationCounts meet(TetComplex& complex)
{
  EnvelopeBounds bounds;
  bounds.rmsLimit = 1;
  GuardedOperations operations(
    complex, [](const Vec3&) { return 1.0; }, bounds);
  meetProximityOfBlock(operations);
  return operations.counts();
}

/// Raises the samples of the interface as `height` says.
template <class Height>
void raise(TetComplex& complex, const Height& height)
{
  for (auto& sample : complex.samples)
    if (sample.position.z > 5.4 && sample.position.z < 5.6) sample.position.z += height(sample.position);
}

TEST(ProximitySplits, LeaveWhatIsNear)
{
  TetComplex complex = floorOfVoxels();
  raise(complex, [](const Vec3&) { return 0.15; });
  const OperationCounts counts = meet(complex);
  EXPECT_EQ(counts.moves + counts.splits + counts.collapses + counts.flips, 0);
}

TEST(ProximitySplits, MoveBeforeTheySplit)
{
  TetComplex complex = floorOfVoxels();
  const auto slope = [](const Vec3& p) { return norm(Vec3{ p.x - 5.5, p.y - 5.5, 0 }) < 3.5 ? 0.3 : 0.; };
  raise(complex, slope);
  const double before = farthest(complex);
  const OperationCounts counts = meet(complex);
  EXPECT_GT(counts.moves, 0);
  EXPECT_LT(farthest(complex), before);
}

TEST(ProximitySplits, SplitWhereMovesDoNotDo)
{
  TetComplex complex = floorOfVoxels();
  const auto bump = [](const Vec3& p) { return norm(Vec3{ p.x - 5, p.y - 5, 0 }) < 0.3 ? 0.45 : 0.; };
  raise(complex, bump);
  const std::size_t tetrahedra = std::size_t(meshOf(complex).tetrahedra.size());
  const double before = farthest(complex);
  const auto topology = meshTopology(meshOf(complex));
  const OperationCounts counts = meet(complex);
  EXPECT_GT(counts.t2, 0);
  EXPECT_EQ(counts.collapses, 0);
  EXPECT_GT(meshOf(complex).tetrahedra.size(), tetrahedra);
  EXPECT_LT(farthest(complex), before);
  EXPECT_TRUE(meshTopology(meshOf(complex)) == topology);
}

} // namespace
} // namespace surgicalmesher
