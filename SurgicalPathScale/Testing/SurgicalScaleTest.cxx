// SPDX-License-Identifier: Apache-2.0
#include "SurgicalScale.h"
#include "Errors.h"
#include "MeshSizeEstimate.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <random>

using namespace surgicalmesher;

namespace
{

TissueMap boxMap(const std::array<int, 3>& size, const Vec3& spacing, Label label = 1)
{
  TissueMap map;
  map.grid.size = size;
  map.grid.spacing = spacing;
  map.grid.origin = { -31, 12, 5 };
  map.grid.axes = { Vec3{ 0.6, 0.8, 0 }, Vec3{ -0.8, 0.6, 0 }, Vec3{ 0, 0, 1 } };
  map.labels.assign(map.grid.voxelCount(), label);
  return map;
}

SurgicalScaleOptions defaults() { return {}; }

template <typename Visit>
void forEachVoxel(const Grid& grid, Visit visit)
{
  for (int k = 0; k < grid.size[2]; ++k)
  {
    for (int j = 0; j < grid.size[1]; ++j)
    {
      for (int i = 0; i < grid.size[0]; ++i)
      {
        visit(i, j, k, grid.gridToWorld({ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z }));
      }
    }
  }
}

double simplexFaceArea(double length) { return std::sqrt(3) / 2 * length * length; }

void expectUsageError(const SurgicalScaleOptions& options, const std::string& expected)
{
  const TissueMap map = boxMap({ 4, 4, 4 }, { 1, 1, 1 });
  try
  {
    computeSurgicalScale(map, { { 0, 0, 0 } }, {}, options);
    ADD_FAILURE() << "accepted, expected: " << expected;
  }
  catch (const UsageError& error)
  {
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
  }
}

/// The definition of the gradation limit, by all pairs.
std::vector<double> largestLipschitzMinorant(const ScaleField& scale, double slope)
{
  std::vector<double> lowered;
  forEachVoxel(scale.grid,
               [&](int, int, int, const Vec3& x)
               {
                 double least = 1e9;
                 forEachVoxel(scale.grid,
                              [&](int i, int j, int k, const Vec3& y) {
                                least = std::min(least, scale.lengths[scale.grid.index(i, j, k)] + slope * norm(x - y));
                              });
                 lowered.push_back(least);
               });
  return lowered;
}

ScaleField noisyScale(unsigned int seed, const std::array<int, 3>& size)
{
  ScaleField scale;
  scale.grid.size = size;
  scale.grid.spacing = { 1, 1.5, 2 };
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> length(1, 12);
  for (std::size_t n = 0; n < scale.grid.voxelCount(); ++n) scale.lengths.push_back(length(random));
  return scale;
}

} // namespace

TEST(EdgeLength, FollowsTheFormula)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  for (int n = 0; n < 1000; ++n)
  {
    const LengthRange range{ 0.1 + share(random), 2 + 8 * share(random) };
    const Falloff falloff{ 30 * share(random), 1 + 40 * share(random) };
    const double d = 150 * share(random);
    const double expected = d <= falloff.childRadius
                              ? range.minimum
                              : range.minimum + (range.maximum - range.minimum) *
                                                  (1 - std::exp(-(d - falloff.childRadius) / falloff.decayLength));
    EXPECT_NEAR(edgeLength(d, range, falloff), expected, 1e-12);
  }
}

TEST(EdgeLength, RisesContinuouslyFromMinimumToMaximum)
{
  const LengthRange range{ 1, 8 };
  const Falloff falloff{ 10, 25 };
  const double step = 1e-3;
  const double steepest = (range.maximum - range.minimum) / falloff.decayLength;
  for (double d = 0; d < 300; d += step)
  {
    const double rise = edgeLength(d + step, range, falloff) - edgeLength(d, range, falloff);
    ASSERT_GE(rise, 0);
    ASSERT_LE(rise, steepest * step * (1 + 1e-6));
  }
  EXPECT_EQ(edgeLength(0, range, falloff), 1);
  EXPECT_EQ(edgeLength(10, range, falloff), 1);
  EXPECT_EQ(edgeLength(HUGE_VAL, range, falloff), 8);
}

TEST(EdgeLength, RisesByAreaAsThePaperHasIt)
{
  const LengthRange range{ edgeLengthOfArea(2), edgeLengthOfArea(60) };
  const Falloff falloff{ 10, 25 };
  for (const double d : { 0., 9.9, 10., 12.5, 40., 200. })
  {
    const double area = d <= 10 ? 2 : 2 + 58 * (1 - std::exp(-(d - 10) / 25));
    EXPECT_NEAR(edgeLength(d, range, falloff, RisingQuantity::Area), std::sqrt(2 * area / std::sqrt(3)), 1e-12);
    EXPECT_GE(edgeLength(d, range, falloff, RisingQuantity::Area), edgeLength(d, range, falloff) - 1e-12);
  }
  // Where the formula has not begun to rise, and where it has risen, areas and lengths ask for the same.
  for (const double d : { 0., 10., HUGE_VAL })
    EXPECT_NEAR(edgeLength(d, range, falloff, RisingQuantity::Area), edgeLength(d, range, falloff), 1e-12);
  for (const double length : { 0.3, 1., 8. }) EXPECT_NEAR(edgeLengthOfArea(simplexFaceArea(length)), length, 1e-12);
}

TEST(SurgicalScale, IsTheFormulaAtEveryVoxelCentre)
{
  const TissueMap map = boxMap({ 20, 12, 9 }, { 1, 1.5, 3 });
  const std::vector<Vec3> targets{ { -30, 20, 10 }, { -25, 40, 20 } };
  const std::vector<Path> paths{ { { -60, 12, 5 }, { -40, 20, 9 }, { -30, 20, 10 } } };
  SurgicalScaleOptions options;
  options.targetFalloff = { 3, 12 };
  options.pathFalloff = { 1, 6 };
  for (const Combination combination : { Combination::Smaller, Combination::Targets, Combination::Paths })
  {
    options.combination = combination;
    const ScaleField scale = computeSurgicalScale(map, targets, paths, options);
    forEachVoxel(scale.grid,
                 [&](int i, int j, int k, const Vec3& x)
                 {
                   const double byTarget =
                     edgeLength(distanceToPoints(x, targets), options.range, options.targetFalloff);
                   const double byPath = edgeLength(distanceToPaths(x, paths), options.range, options.pathFalloff);
                   const double expected = combination == Combination::Targets ? byTarget
                                           : combination == Combination::Paths ? byPath
                                                                               : std::min(byTarget, byPath);
                   EXPECT_NEAR(scale.lengths[scale.grid.index(i, j, k)], expected, 1e-5);
                 });
  }
}

TEST(SurgicalScale, CoversTheMapWithAVoxelToSpare)
{
  for (const double spacing : { 0.1, 0.25, 0.7, 1.0, 2.0, 5.0, 100.0 })
  {
    const TissueMap map = boxMap({ 20, 12, 9 }, { 1, 1.5, 3 });
    const Grid grid = scaleGrid(map.grid, spacing);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(grid.axes[axis], map.grid.axes[axis]);
      EXPECT_EQ(grid.spacing[axis], spacing);
      const Vec3 first = map.grid.worldToGrid(grid.origin);
      const double below = -0.5 * map.grid.spacing[axis] - (first[axis] - 0.5 * spacing);
      const double above =
        first[axis] + (grid.size[axis] - 0.5) * spacing - (map.grid.size[axis] - 0.5) * map.grid.spacing[axis];
      EXPECT_GE(below, spacing * (1 - 1e-9));
      const double beyond = 0.2 * map.grid.spacing[axis]; // the surface's
      EXPECT_GE(below, beyond * (1 - 1e-3));
      EXPECT_LT(below, 1.5 * spacing + (beyond > spacing ? beyond : 0) + 1e-9);
      EXPECT_NEAR(below, above, 1e-9);
    }
  }
}

TEST(SurgicalScale, GivesTissuesTheirOwnLengths)
{
  TissueMap map = boxMap({ 40, 40, 40 }, { 1, 1, 1 });
  for (int k = 0; k < 40; ++k)
  {
    for (int j = 0; j < 40; ++j)
    {
      for (int i = 0; i < 40; ++i) map.labels[map.grid.index(i, j, k)] = i < 18 ? 1 : i < 20 ? 2 : i < 38 ? 3 : 0;
    }
  }
  const std::vector<Vec3> target{ map.grid.gridToWorld({ 20, 20, 20 }) };
  SurgicalScaleOptions options;
  options.targetFalloff = { 2, 8 };
  options.tissues[2] = { { 0.5, 2 }, 1 };
  options.tissues[3] = { { 2, 8 }, 2 };
  options.spacing = 3;
  const ScaleField scale = computeSurgicalScale(map, target, {}, options);
  forEachVoxel(
    map.grid,
    [&](int i, int j, int k, const Vec3& x)
    {
      const double d = norm(x - target[0]);
      const Label label = map.labels[map.grid.index(i, j, k)];
      // A scale voxel away in any direction.
      const double farther = d + options.spacing * std::sqrt(3.0);
      if (label == 1)
      {
        EXPECT_LE(scale(x), edgeLength(farther, options.range, options.targetFalloff));
      }
      if (label == 2)
      {
        EXPECT_LE(scale(x), edgeLength(farther, { 0.5, 2 }, options.targetFalloff));
      }
      if (label == 3)
      {
        EXPECT_LE(scale(x), 2 * edgeLength(farther, { 2, 8 }, options.targetFalloff));
      }
      const bool isDeep = i > 20 + 2 * options.spacing && i < 38 - 2 * options.spacing;
      if (isDeep)
      {
        EXPECT_GE(scale(x), 2 * edgeLength(std::max(0.0, d - options.spacing * 2), { 2, 8 }, options.targetFalloff));
      }
    });
}

TEST(SurgicalScale, IsTheSameForARotatedCopy)
{
  TissueMap map = boxMap({ 15, 13, 11 }, { 1, 1.5, 2 });
  TissueMap straight = map;
  straight.grid.axes = { Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } };
  straight.grid.origin = { 0, 0, 0 };
  const Vec3 p{ 4, 5, 6 };
  const Path path{ { 0, 1, 2 }, { 9, 9, 9 } };
  const ScaleField a = computeSurgicalScale(straight, { p }, { path }, defaults());
  const ScaleField b = computeSurgicalScale(
    map, { map.grid.gridToWorld(p) }, { { map.grid.gridToWorld(path[0]), map.grid.gridToWorld(path[1]) } }, defaults());
  ASSERT_EQ(a.lengths.size(), b.lengths.size());
  for (std::size_t n = 0; n < a.lengths.size(); ++n) EXPECT_NEAR(a.lengths[n], b.lengths[n], 1e-5);
}

TEST(SurgicalScale, DoesNotDependOnTheThreads)
{
  TissueMap map = boxMap({ 30, 30, 30 }, { 1, 1, 1 });
  std::mt19937 random(2);
  for (Label& label : map.labels) label = Label(random() % 4);
  SurgicalScaleOptions options;
  options.gradation = 0.1;
  options.tissues[2] = { { 0.5, 3 }, 1 };
  std::vector<ScaleField> scales;
  std::vector<MeshSizeEstimate> estimates;
  for (const int threads : { 1, 2, 5 })
  {
    vtkSMPTools::Initialize(threads);
    scales.push_back(computeSurgicalScale(map, { map.grid.gridToWorld({ 3, 4, 5 }) }, {}, options));
    estimates.push_back(estimateMeshSize(map, scales.back()));
  }
  vtkSMPTools::Initialize(0);
  for (std::size_t n = 1; n < scales.size(); ++n)
  {
    EXPECT_EQ(scales[n].lengths, scales[0].lengths);
    EXPECT_EQ(estimates[n].triangles, estimates[0].triangles);
    EXPECT_EQ(estimates[n].tetrahedra, estimates[0].tetrahedra);
  }
}

TEST(SurgicalScale, RefusesLengthsAndDistancesThatAreNone)
{
  for (const double bad : { 0.0, -1.0, std::nan(""), HUGE_VAL })
  {
    SurgicalScaleOptions options;
    options.range.minimum = bad;
    expectUsageError(options, "the minimum edge length is");
    options = defaults();
    options.range.maximum = bad;
    expectUsageError(options, "the maximum edge length is");
    options = defaults();
    options.targetFalloff.decayLength = bad;
    expectUsageError(options, "the decay length is");
    options = defaults();
    options.pathFalloff.decayLength = bad;
    expectUsageError(options, "the decay length is");
    options = defaults();
    options.spacing = bad;
    expectUsageError(options, "the spacing of the scale volume is");
    options = defaults();
    options.tissues[3].factor = bad;
    expectUsageError(options, "a tissue's factor is");
    if (bad == 0) continue;
    options = defaults();
    options.targetFalloff.childRadius = bad;
    expectUsageError(options, "the child radius is");
    options = defaults();
    options.gradation = bad;
    expectUsageError(options, "the gradation limit is");
  }
  SurgicalScaleOptions options;
  options.range = { 3, 2 };
  expectUsageError(options, "the minimum edge length, 3 mm, is above the maximum, 2 mm");
  options = defaults();
  options.spacing = 1e-3;
  expectUsageError(options, "fewer than 2^31 voxels");
}

TEST(SurgicalScale, NeedsWhatItIsToFollow)
{
  const TissueMap map = boxMap({ 4, 4, 4 }, { 1, 1, 1 });
  const Path path{ { 0, 0, 0 }, { 1, 0, 0 } };
  SurgicalScaleOptions options;
  EXPECT_THROW(computeSurgicalScale(map, {}, {}, options), UsageError);
  EXPECT_THROW(computeSurgicalScale(map, {}, { { { 0, 0, 0 } } }, options), InputError);
  options.combination = Combination::Targets;
  EXPECT_THROW(computeSurgicalScale(map, {}, { path }, options), UsageError);
  options.combination = Combination::Paths;
  EXPECT_THROW(computeSurgicalScale(map, { { 0, 0, 0 } }, {}, options), UsageError);
}

TEST(SurgicalScale, SufficientSpacingKeepsLengthsAtTargetsAndPaths)
{
  std::mt19937 random(3);
  const auto between = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  TissueMap map = boxMap({ 30, 30, 30 }, { 1, 1, 1 });
  for (std::size_t n = map.labels.size() / 2; n < map.labels.size(); ++n) map.labels[n] = 2;
  const auto place = [&](double lowest, double highest) {
    return map.grid.gridToWorld({ between(5, 24), between(5, 24), between(lowest, highest) });
  };
  std::size_t kept = 0, lost = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    SurgicalScaleOptions options;
    options.range.minimum = between(0.1, 2);
    options.range.maximum = options.range.minimum * between(1, 20);
    options.targetFalloff = { trial % 3 ? between(0, 6) : 0, between(1, 20) };
    options.pathFalloff = { between(0, 6), between(1, 20) };
    options.rising = trial % 2 ? RisingQuantity::Area : RisingQuantity::Length;
    options.combination = Combination(trial % 3);
    const double own = between(0.1, 2), factor = between(0.5, 2);
    if (trial % 4 == 0) options.tissues[2] = { { own, own * between(1, 20) }, factor };
    // Far from each other, so that each has its own minimum, and each wholly in one tissue.
    const std::vector<Vec3> targets{ place(1, 12) };
    const std::vector<Path> paths{ { place(17, 28), place(17, 28) } };
    const auto overWanted = [&](double spacing)
    {
      options.spacing = spacing;
      const ScaleField scale = computeSurgicalScale(map, targets, paths, options);
      const double inTissue = options.tissues.empty() ? options.range.minimum : own * factor;
      double most = 0;
      if (options.combination != Combination::Paths) most = scale(targets[0]) / options.range.minimum;
      if (options.combination == Combination::Targets) return most;
      for (const Vec3& point : paths[0]) most = std::max(most, scale(point) / inTissue);
      return most;
    };
    const double sufficient = sufficientSpacing(options, targets, paths);
    if (sufficient > 0.5)
    {
      EXPECT_LE(overWanted(std::min(sufficient, 40.0)), 1.5 + 1e-6) << "trial " << trial;
      ++kept;
    }
    lost += overWanted(std::clamp(4 * sufficient, 0.5, 40.0)) > 1.5;
  }
  EXPECT_GT(kept, 100u);
  EXPECT_GT(lost, 50u) << "it asks for much less than it has to";
}

TEST(SurgicalScale, SufficientSpacingAsksForNothingWhereNothingRises)
{
  const std::vector<Vec3> targets{ { 0, 0, 0 } };
  const std::vector<Path> paths{ { { 0, 0, 0 }, { 1, 0, 0 } } };
  SurgicalScaleOptions options;
  options.targetFalloff = { 3, 1 };
  options.pathFalloff = { 0.1, 1 };
  const double ofTargets = sufficientSpacing(options, targets, {}), ofBoth = sufficientSpacing(options, targets, paths);
  EXPECT_GT(ofTargets, 3 / std::sqrt(3));
  EXPECT_LT(ofBoth, 0.2);
  options.combination = Combination::Targets;
  EXPECT_EQ(sufficientSpacing(options, targets, paths), ofTargets);
  options.combination = Combination::Paths;
  EXPECT_EQ(sufficientSpacing(options, targets, paths), ofBoth);
  options.range.maximum = options.range.minimum;
  EXPECT_TRUE(std::isinf(sufficientSpacing(options, targets, paths)));
}

TEST(Gradation, IsTheLargestLipschitzMinorant)
{
  for (const double slope : { 0.05, 0.3, 1.0, 4.0 })
  {
    for (const std::array<int, 3>& size : { std::array<int, 3>{ 9, 7, 8 }, { 1, 1, 1 }, { 17, 1, 2 } })
    {
      ScaleField scale = noisyScale(4, size);
      const ScaleField before = scale;
      const std::vector<double> expected = largestLipschitzMinorant(scale, slope);
      limitGradation(scale, slope);
      for (std::size_t n = 0; n < expected.size(); ++n)
      {
        EXPECT_NEAR(scale.lengths[n], expected[n], 1e-5);
        EXPECT_LE(scale.lengths[n], before.lengths[n]);
      }
    }
  }
}

TEST(Gradation, LeavesASmoothScaleAlone)
{
  const TissueMap map = boxMap({ 24, 24, 24 }, { 2, 2, 2 });
  SurgicalScaleOptions options;
  const std::vector<Vec3> target{ map.grid.gridToWorld({ 10, 20, 30 }) };
  const ScaleField smooth = computeSurgicalScale(map, target, {}, options);
  options.gradation = (options.range.maximum - options.range.minimum) / options.targetFalloff.decayLength * 1.001;
  EXPECT_EQ(computeSurgicalScale(map, target, {}, options).lengths, smooth.lengths);
  ScaleField twice = noisyScale(9, { 8, 8, 8 });
  limitGradation(twice, 0.5);
  const std::vector<float> once = twice.lengths;
  limitGradation(twice, 0.5);
  for (std::size_t n = 0; n < once.size(); ++n) EXPECT_NEAR(twice.lengths[n], once[n], 2e-6);
}
