// SPDX-License-Identifier: Apache-2.0
#include "VertexReturn.h"
#include "Groove.h"
#include "Improvement.h"
#include "Polishing.h"
#include "RandomMaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

using namespace test;

const SizingFunction unitScale = [](const Vec3&) { return 1.0f; };
constexpr double leastWay = 0.18;

/// Every sample is within reach.
EnvelopeBounds wide()
{
  EnvelopeBounds bounds;
  bounds.rmsLimit = 1;
  return bounds;
}

EnvelopeBounds held()
{
  EnvelopeBounds bounds;
  bounds.interfaceHeld = true;
  return bounds;
}

VertexReturnOptions optionsOf(double goodAngle, double foldsFrom = 0)
{
  VertexReturnOptions options;
  options.goodAngle = goodAngle;
  options.leastWay = leastWay;
  options.foldsFrom = foldsFrom;
  return options;
}

double worstOf(const TetComplex& complex)
{
  double worst = std::numeric_limits<double>::max();
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    if (complex.alive(t)) worst = std::min(worst, complex.quality(t));
  return worst;
}

/// Two slabs with their wall at z = 2.5.
TetComplex slabs()
{
  return complexOf(tetrahedraOf(paintedMap({ 6, 6, 6 }, [](int, int, int k) { return k < 3 ? 1 : 2; })), 1, 1);
}

/// A vertex of the wall so far off it, and the tetrahedra around fitted to that as if it were right.
struct Dent
{
  TetComplex complex = slabs();
  std::int32_t v = vertexNear(complex, { 2.5, 2.5, 2.5 });
  static constexpr double depth = 0.3;

  Dent()
  {
    GuardedOperations moving(complex, unitScale, wide());
    EXPECT_TRUE(moving.move(v, complex.points[v] + Vec3{ 0, 0, depth }, 1e-6));
    GuardedOperations fitting(complex, unitScale, held());
    ImprovementOptions options;
    options.targetAngle = 60;
    options.trials = 40;
    options.split = false;
    improveBlock(fitting, options);
  }
  double off() const { return std::abs(complex.points[v].z - 2.5); }
};

TEST(VertexReturn, BringsBackWhatTetrahedraHold)
{
  constexpr double goodAngle = 36;
  Dent dent;
  ASSERT_DOUBLE_EQ(dent.off(), dent.depth);
  ASSERT_GE(worstOf(dent.complex), sine2OfDegrees(goodAngle));
  GuardedOperations operations(dent.complex, unitScale, wide());
  PolishingOptions alone;
  alone.goodAngle = goodAngle;
  alone.fit = 10;
  alone.climbs = false;
  polishBlock(operations, alone);
  ASSERT_DOUBLE_EQ(dent.off(), dent.depth) << "alone it can go back, and the test shows nothing";
  returnVerticesOfBlock(operations, optionsOf(goodAngle));
  EXPECT_LT(dent.off(), leastWay);
  EXPECT_GE(worstOf(dent.complex), sine2OfDegrees(goodAngle));
  EXPECT_TRUE(isConsistent(dent.complex));
}

TEST(VertexReturn, LeavesEverythingWhereAnglesDoNotComeBack)
{
  Dent dent;
  for (std::size_t v = 0; v < dent.complex.points.size(); ++v) dent.complex.locked[v] = std::int32_t(v) != dent.v;
  const ComplexState before(dent.complex);
  GuardedOperations operations(dent.complex, unitScale, wide());
  returnVerticesOfBlock(operations, optionsOf(89));
  EXPECT_TRUE(ComplexState(dent.complex) == before);
}

TEST(VertexReturn, LeavesWhatIsNearForItsTriangles)
{
  const auto offAfter = [](double share)
  {
    Dent dent;
    GuardedOperations operations(dent.complex, unitScale, wide());
    VertexReturnOptions options = optionsOf(36);
    options.leastShare = share;
    returnVerticesOfBlock(operations, options);
    return dent.off();
  };
  EXPECT_DOUBLE_EQ(offAfter(10), Dent::depth);
  EXPECT_LT(offAfter(0.5 * Dent::depth), leastWay);
}

TEST(VertexReturn, LeavesWhatIsNear)
{
  TetComplex complex = slabs();
  GuardedOperations operations(complex, unitScale, wide());
  const std::int32_t v = vertexNear(complex, { 2.5, 2.5, 2.5 });
  ASSERT_TRUE(operations.move(v, complex.points[v] + Vec3{ 0, 0, 0.02 }, 1e-6));
  const ComplexState before(complex);
  returnVerticesOfBlock(operations, optionsOf(5));
  EXPECT_TRUE(ComplexState(complex) == before);
}

/// Samples of a groove of 98 degrees, and a vertex of its seam above them: all the way back, more would be folded.
TEST(VertexReturn, FoldsNothingButFineTriangles)
{
  for (const double foldsFrom : { 0.0, 2.0 })
  {
    TetComplex complex = groove(8, 1);
    const std::int32_t v = vertexNear(complex, { 2.5, 2.5, 2.5 });
    for (std::size_t n = 0; n < complex.points.size(); ++n) complex.locked[n] = std::int32_t(n) != v;
    GuardedOperations operations(complex, unitScale, wide());
    ASSERT_TRUE(operations.move(v, complex.points[v] + Vec3{ 0.3, 0, 0.3 }, 1e-6));
    const Vec3 above = complex.points[v];
    returnVerticesOfBlock(operations, optionsOf(1, foldsFrom));
    EXPECT_EQ(complex.points[v] == above, foldsFrom == 0);
    EXPECT_TRUE(isConsistent(complex));
  }
}

/// On noise, off whose samples vertices have been shaken: more near them than before, no angle lost, nothing inverted.
TEST(VertexReturn, KeepsWhatEveryOperationKeeps)
{
  std::size_t before = 0, after = 0;
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TissueMap map = randomWellComposedMap(random, { 5, 5, 5 }, 1 + int(seed % 4));
    TetComplex complex = complexOf(tetrahedraOf(map), 1, 0.5f);
    GuardedOperations operations(complex, unitScale, wide());
    const auto uniform = [&] { return random() / 2147483648.0 - 1; };
    for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
      operations.move(v, complex.points[v] + 0.4 * Vec3{ uniform(), uniform(), uniform() }, 1e-3);
    const auto farOff = [&]
    {
      std::size_t count = 0;
      for (const SamplePlace& place : samplePlaces(complex)) count += place.distance > leastWay;
      return count;
    };
    const auto topology = meshTopology(withBackgroundAsTissue(meshOf(complex)));
    const double worst = worstQuality(operations, complex);
    before += farOff();
    returnVerticesOfBlock(operations, optionsOf(28.5));
    after += farOff();
    EXPECT_GE(worstQuality(operations, complex), worst);
    EXPECT_EQ(meshTopology(withBackgroundAsTissue(meshOf(complex))), topology);
    ASSERT_TRUE(isConsistent(complex));
  }
  EXPECT_LT(after, before);
}

} // namespace
} // namespace surgicalmesher
