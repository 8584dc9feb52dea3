// SPDX-License-Identifier: Apache-2.0
#include "ConstitutiveTags.h"

#include "Errors.h"
#include "FaceAdjacency.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace surgicalmesher
{
namespace
{

TetMesh block()
{
  return withoutOutside(test::tetrahedraOf(test::paintedMap({ 12, 6, 6 }, [](int, int, int) { return 1; })));
}

/// The classes that `rule` gives to a mesh of linear tetrahedra, and the centroids they belong to.
std::vector<std::pair<Vec3, std::int32_t>> tagged(const ConstitutiveRule& rule, std::int32_t before = 0)
{
  const TetMesh mesh = block();
  std::vector<std::int32_t> tags(mesh.tetrahedra.size(), before);
  tagByDistance(mesh, rule, tags);
  std::vector<std::pair<Vec3, std::int32_t>> result;
  for (std::size_t t = 0; t < tags.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    result.push_back({ 0.25 * (mesh.points[a] + mesh.points[b] + mesh.points[c] + mesh.points[d]), tags[t] });
  }
  return result;
}

TEST(ConstitutiveTags, NearIsNonlinearFarIsHeldStill)
{
  ConstitutiveRule rule;
  rule.targets = { { 1, 2, 2 } };
  rule.nonlinearDistance = 3;
  rule.nullTargetRadius = 7;
  for (const auto& [x, tag] : tagged(rule, 1))
  {
    const double distance = norm(x - rule.targets[0]);
    EXPECT_EQ(tag, distance <= 3 ? 1 : distance <= 7 ? 0 : 2) << distance;
  }
}

TEST(ConstitutiveTags, PathsCountLikeTargets)
{
  ConstitutiveRule rule;
  rule.paths = { { { 0, 0, 0 }, { 11, 0, 0 } } };
  rule.nonlinearDistance = 2;
  rule.nullPathDistance = 2.5;
  rule.nullPathDistanceAtTarget = 5;
  std::set<std::int32_t> seen;
  for (const auto& [x, tag] : tagged(rule))
  {
    const double toPath = distanceToSegment(x, { 0, 0, 0 }, { 11, 0, 0 });
    const bool inTube = distanceToTube(x, rule.paths[0], 2.5, 5) <= 0;
    EXPECT_EQ(tag, !inTube ? 2 : toPath <= 2 ? 1 : 0);
    seen.insert(tag);
  }
  EXPECT_EQ(seen, (std::set<std::int32_t>{ 0, 1, 2 }));
}

TEST(ConstitutiveTags, TheNonlinearDistanceTapersAlongPaths)
{
  ConstitutiveRule rule;
  rule.paths = { { { 0, 2, 2 }, { 6, 2, 2 }, { 11, 2, 2 } } };
  rule.targets = { { 11, 5, 5 } };
  rule.nonlinearDistance = 1;
  rule.nonlinearDistanceAtTarget = 3;
  std::set<std::int32_t> seen;
  for (const auto& [x, tag] : tagged(rule))
  {
    bool isNear = norm(x - rule.targets[0]) <= 1; // the taper is the path's alone
    for (int n = 0; n <= 11000 && !isNear; ++n)
    {
      const double u = n / 11000.0;
      isNear = norm(x - Vec3{ 11 * u, 2, 2 }) <= 1 + 2 * u;
    }
    EXPECT_EQ(tag, isNear ? 1 : 0) << x.x << " " << x.y << " " << x.z;
    seen.insert(tag);
  }
  EXPECT_EQ(seen, (std::set<std::int32_t>{ 0, 1 }));
}

TEST(ConstitutiveTags, WithoutDistancesNothingChanges)
{
  for (const std::int32_t before : { 0, 1, 2 })
  {
    for (const auto& entry : tagged({}, before)) EXPECT_EQ(entry.second, before);
  }
}

TEST(ConstitutiveTags, NullDisplacementTissueStaysSo)
{
  ConstitutiveRule rule;
  rule.targets = { { 5, 2, 2 } };
  rule.nonlinearDistance = 100;
  for (const auto& entry : tagged(rule, 2)) EXPECT_EQ(entry.second, 2);
}

TEST(ConstitutiveTags, RefusesRulesWithoutMeaning)
{
  const auto refused = [](auto change)
  {
    ConstitutiveRule rule;
    change(rule);
    EXPECT_THROW(checkConstitutiveRule(rule), UsageError);
  };
  refused([](ConstitutiveRule& r) { r.nonlinearDistance = 5; });
  refused([](ConstitutiveRule& r) { r.targets = { {} }; });
  refused([](ConstitutiveRule& r) { r.paths = { { {}, { 1, 0, 0 } } }, r.nullTargetRadius = 5; });
  refused([](ConstitutiveRule& r) { r.targets = { {} }, r.nullPathDistance = 5; });
  refused([](ConstitutiveRule& r) { r.targets = { {} }, r.nonlinearDistance = 5, r.nullPathDistanceAtTarget = 5; });
  refused([](ConstitutiveRule& r) { r.targets = { {} }, r.nonlinearDistance = 5, r.nonlinearDistanceAtTarget = 5; });
  refused(
    [](ConstitutiveRule& r) {
      r.paths = { { {}, { 1, 0, 0 } } }, r.nullPathDistance = 5, r.nonlinearDistanceAtTarget = 5;
    });
  for (const double bad : { -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    refused([=](ConstitutiveRule& r) { r.targets = { {} }, r.nonlinearDistance = bad; });
    refused([=](ConstitutiveRule& r) { r.targets = { {} }, r.nullTargetRadius = bad; });
  }
}

} // namespace
} // namespace surgicalmesher
