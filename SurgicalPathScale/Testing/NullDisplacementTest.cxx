// SPDX-License-Identifier: Apache-2.0
#include "NullDisplacement.h"
#include "Errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace surgicalmesher;

namespace
{

const std::vector<Vec3> targets{ { 3, 4, 5 }, { 14, 10, 20 } };
const std::vector<Path> paths{ { { 0, 0, 0 }, { 8, 6, 0 }, { 8, 6, 24 } }, { { 20, 0, 10 }, { 12, 12, 12 } } };

TissueMap noisyMap()
{
  TissueMap map;
  map.grid.size = { 20, 14, 10 };
  map.grid.spacing = { 1, 1, 2.5 };
  std::mt19937 random(8);
  for (std::size_t n = 0; n < map.grid.voxelCount(); ++n) map.labels.push_back(Label(random() % 5));
  return map;
}

/// Near some point of a path, its threshold there considered; sampled.
bool isInTube(const Vec3& x, const Path& path, double atEntry, double atTarget)
{
  double arc = 0;
  for (std::size_t n = 1; n < path.size(); ++n)
  {
    const double length = norm(path[n] - path[n - 1]);
    for (double u = 0; u <= 1; u += 1e-4)
    {
      const double share = (arc + u * length) / pathLength(path);
      if (norm(x - (path[n - 1] + u * (path[n] - path[n - 1]))) <= atEntry + share * (atTarget - atEntry)) return true;
    }
    arc += length;
  }
  return false;
}

void expectAsDefined(const NullDisplacementOptions& options)
{
  const TissueMap before = noisyMap();
  TissueMap map = before;
  const NullDisplacement result = markNullDisplacement(map, targets, paths, options);
  const double atTarget = options.pathDistanceAtTarget > 0 ? options.pathDistanceAtTarget : options.pathDistance;
  std::size_t count = 0;
  for (int k = 0; k < map.grid.size[2]; ++k)
  {
    for (int j = 0; j < map.grid.size[1]; ++j)
    {
      for (int i = 0; i < map.grid.size[0]; ++i)
      {
        const Vec3 x{ i * 1.0, j * 1.0, k * 2.5 };
        const Label label = before.labels[map.grid.index(i, j, k)];
        const bool takesPart = options.tissues.empty() ? label != 0 : options.tissues.count(label) > 0;
        bool isNear = options.targetRadius > 0 && distanceToPoints(x, targets) <= options.targetRadius;
        for (const Path& path : paths)
        {
          isNear = isNear || (options.pathDistance > 0 && isInTube(x, path, options.pathDistance, atTarget));
        }
        EXPECT_EQ(map.labels[map.grid.index(i, j, k)], takesPart && !isNear ? result.label : label);
        count += takesPart && !isNear;
      }
    }
  }
  EXPECT_GT(count, 0u);
  EXPECT_EQ(result.voxelCount, count);
  EXPECT_EQ(result.label, 5);
  EXPECT_EQ(map.table.at(5).name, "null displacement");
}

void expectUsageError(const std::vector<Vec3>& points, const std::vector<Path>& lines,
                      const NullDisplacementOptions& options)
{
  TissueMap map = noisyMap();
  EXPECT_THROW(markNullDisplacement(map, points, lines, options), UsageError);
  EXPECT_EQ(map.labels, noisyMap().labels);
}

} // namespace

TEST(NullDisplacement, FollowsItsDefinition)
{
  expectAsDefined({ 6.1, 0, 0, {} });
  expectAsDefined({ 0, 4.3, 0, {} });
  expectAsDefined({ 3.1, 4.3, 0, {} });
  expectAsDefined({ 0, 6.3, 1.7, {} });
  expectAsDefined({ 3.1, 1.7, 6.3, {} });
  expectAsDefined({ 6.1, 0, 0, { 2, 4 } });
  expectAsDefined({ 6.1, 0, 0, { 0, 3 } });
}

TEST(NullDisplacement, NeedsACriterionAndWhatItMeasuresFrom)
{
  expectUsageError(targets, paths, {});
  expectUsageError(targets, paths, { -1, 0, 0, {} });
  expectUsageError(targets, paths, { std::nan(""), 0, 0, {} });
  expectUsageError(targets, paths, { 0, HUGE_VAL, 0, {} });
  expectUsageError({}, paths, { 5, 5, 0, {} });
  expectUsageError(targets, {}, { 5, 5, 0, {} });
}

TEST(NullDisplacement, TakesAFreeLabel)
{
  TissueMap map = noisyMap();
  map.labels[0] = 65535;
  std::replace(map.labels.begin(), map.labels.end(), Label(3), Label(4));
  EXPECT_EQ(markNullDisplacement(map, targets, paths, { 1, 0, 0, {} }).label, 3);

  map.grid.size = { 65536, 1, 1 };
  map.labels.resize(65536);
  for (std::size_t n = 0; n < 65536; ++n) map.labels[n] = Label(n);
  EXPECT_THROW(markNullDisplacement(map, targets, paths, { 1, 0, 0, {} }), InputError);
}
