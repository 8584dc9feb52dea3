// SPDX-License-Identifier: Apache-2.0
#include "MeshQuality.h"
#include "FaceAdjacency.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <rapidjson/document.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace surgicalmesher
{
namespace
{

using Corners = std::array<Vec3, 4>;

const Corners regular{ Vec3{ 1, 1, 1 }, Vec3{ 1, -1, -1 }, Vec3{ -1, 1, -1 }, Vec3{ -1, -1, 1 } };
/// Two neighbouring cube centres and the edge between their cubes: Fuchs' canonical tetrahedron.
const Corners canonical{ Vec3{ 0, 0, -1 }, Vec3{ 0, 0, 1 }, Vec3{ 1, -1, 0 }, Vec3{ 1, 1, 0 } };

TEST(TetrahedronQuality, RegularTetrahedron)
{
  const auto& [a, b, c, d] = regular;
  const double sign = orient(a, b, c, d) > 0 ? 1 : -1;
  for (const double angle : dihedralAngles(a, b, c, d)) EXPECT_NEAR(angle, std::acos(1.0 / 3) * 180 / M_PI, 1e-12);
  EXPECT_NEAR(radiusRatio(a, b, c, d), sign, 1e-14);
  EXPECT_NEAR(scaledJacobian(a, b, c, d), sign, 1e-14);
}

TEST(TetrahedronQuality, CanonicalTetrahedron)
{
  auto [a, b, c, d] = canonical;
  if (orient(a, b, c, d) < 0) std::swap(a, b);
  auto angles = dihedralAngles(a, b, c, d);
  std::sort(angles.begin(), angles.end());
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(angles[i], i < 4 ? 60 : 90, 1e-12);
  EXPECT_NEAR(radiusRatio(a, b, c, d), std::sqrt(0.9), 1e-14);
  const double shortEdge = std::sqrt(3), longEdge = 2;
  EXPECT_NEAR(scaledJacobian(a, b, c, d), std::sqrt(2) * orient(a, b, c, d) / (shortEdge * shortEdge * longEdge),
              1e-14);
}

TEST(CountBelow, CountsTissueWithSmallOrLargeAngles)
{
  TetMesh mesh;
  for (auto [a, b, c, d] : { regular, canonical, canonical })
  {
    if (orient(a, b, c, d) < 0) std::swap(a, b);
    const std::int32_t first = std::int32_t(mesh.points.size());
    mesh.points.insert(mesh.points.end(), { a, b, c, d });
    mesh.tetrahedra.push_back({ first, first + 1, first + 2, first + 3 });
  }
  mesh.labels = { 1, 2, 0 };
  EXPECT_EQ(countBelow(mesh, 59.9), 0u);
  EXPECT_EQ(countBelow(mesh, 60.1), 1u);
  EXPECT_EQ(countBelow(mesh, 71), 2u);
  EXPECT_EQ(countBelow({}, 71), 0u);
}

TEST(TetrahedronQuality, DoesNotDependOnSizePlaceOrCornerOrder)
{
  auto [a, b, c, d] = canonical;
  if (orient(a, b, c, d) < 0) std::swap(a, b);
  const Vec3 shift{ 100, -50, 30 };
  const auto moved = [&](const Vec3& p) { return 0.01 * p + shift; };
  EXPECT_NEAR(radiusRatio(moved(a), moved(b), moved(c), moved(d)), radiusRatio(a, b, c, d), 1e-9);
  EXPECT_NEAR(scaledJacobian(moved(b), moved(c), moved(a), moved(d)), scaledJacobian(a, b, c, d), 1e-9);
  EXPECT_NEAR(radiusRatio(b, a, c, d), -radiusRatio(a, b, c, d), 1e-14);
  EXPECT_EQ(radiusRatio(a, b, c, a), 0);
}

TEST(Distribution, HasThePercentilesOfTheSortedValues)
{
  for (int count : { 1, 2, 3, 20, 1001 })
  {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(i * 617 % count);
    const Distribution d = distributionOf(values);
    const auto nearest = [&](double share) { return std::floor(share * (count - 1) + 0.5); };
    EXPECT_EQ(d.count, std::size_t(count));
    EXPECT_EQ(d.minimum, 0);
    EXPECT_EQ(d.percentile1, nearest(0.01));
    EXPECT_EQ(d.percentile5, nearest(0.05));
    EXPECT_EQ(d.median, nearest(0.5));
    EXPECT_EQ(d.percentile95, nearest(0.95));
    EXPECT_EQ(d.percentile99, nearest(0.99));
    EXPECT_EQ(d.maximum, count - 1);
    EXPECT_NEAR(d.mean, 0.5 * (count - 1), 1e-9);
  }
}

TEST(AssessQuality, GroupsAddUp)
{
  const TetMesh mesh = withoutOutside(test::tetrahedraOf(
    test::paintedMap({ 4, 4, 4 }, [](int i, int j, int) { return 1 + (i > 1) + (i > 1 && j > 1); }, { 1, 1, 1 })));
  std::vector<std::int32_t> subMesh(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < subMesh.size(); ++t) subMesh[t] = t % 5 == 0;
  const MeshQuality quality = assessQuality(mesh, subMesh, [](const Vec3&) { return 1.25; });
  EXPECT_NEAR(quality.whole.volume, 64, 1e-9);
  EXPECT_NEAR(quality.tissues.at(1).volume, 32, 1e-9);
  EXPECT_NEAR(quality.tissues.at(3).volume, 16, 1e-9);
  EXPECT_EQ(quality.subMeshes.at(0).tetrahedra + quality.subMeshes.at(1).tetrahedra, mesh.tetrahedra.size());
  EXPECT_EQ(quality.whole.points, 125u);
  EXPECT_NEAR(quality.whole.dihedral.minimum, 45, 1e-9);
  EXPECT_NEAR(quality.whole.dihedral.maximum, 90, 1e-9);
  EXPECT_NEAR(quality.whole.edgeOverTarget.minimum, 1 / 1.25, 1e-12);
  EXPECT_NEAR(quality.whole.edgeOverTarget.maximum, std::sqrt(3) / 1.25, 1e-12);
  EXPECT_EQ(quality.whole.valence.median, 24) << "Kuhn's partition has 24 tetrahedra at a vertex";
  EXPECT_EQ(quality.whole.dihedral.count, 6 * mesh.tetrahedra.size());
}

TEST(AssessQuality, LengthsAtPointsCountByTheMeanOfBothEnds)
{
  const TetMesh mesh = test::tetrahedraOf(test::paintedMap({ 3, 3, 3 }, [](int, int, int) { return 1; }));
  const auto growing = [](const Vec3& p) { return 1 + 0.2 * p.x; };
  std::vector<double> lengths;
  for (const Vec3& p : mesh.points) lengths.push_back(growing(p));
  const Distribution byPoints = assessQualityFromPoints(mesh, {}, lengths).whole.edgeOverTarget,
                     byPlaces = assessQuality(mesh, {}, growing).whole.edgeOverTarget;
  EXPECT_NEAR(byPoints.minimum, byPlaces.minimum, 1e-12);
  EXPECT_NEAR(byPoints.mean, byPlaces.mean, 1e-12);
  EXPECT_NEAR(byPoints.maximum, byPlaces.maximum, 1e-12);
  EXPECT_EQ(assessQualityFromPoints(mesh, {}, {}).whole.edgeOverTarget.count, 0u);
}

TEST(AssessQuality, HistogramsCountEverything)
{
  const TetMesh mesh =
    withoutOutside(test::tetrahedraOf(test::paintedMap({ 3, 3, 3 }, [](int, int, int) { return 1; })));
  const MeshQuality quality = assessQuality(mesh, {}, [](const Vec3&) { return 0.1; });
  const auto total = [](const Histogram& h)
  { return std::accumulate(h.counts.begin(), h.counts.end(), std::size_t(0)); };
  EXPECT_EQ(total(quality.dihedral), 6 * mesh.tetrahedra.size());
  EXPECT_EQ(total(quality.edgeOverTarget), quality.whole.edgeOverTarget.count) << "values beyond the range are kept";
  EXPECT_EQ(quality.valence.counts[24], 8u) << "the inner points of 3 x 3 x 3 voxels";
  EXPECT_EQ(total(quality.boundaryValence), 64u - 8u);
}

TEST(AssessQuality, BoundaryPointsCountOnceForEachTissue)
{
  const TetMesh mesh =
    withoutOutside(test::tetrahedraOf(test::paintedMap({ 4, 3, 3 }, [](int i, int, int) { return 1 + i / 2; })));
  const MeshQuality quality = assessQuality(mesh, {}, {});
  std::size_t points = 0, uses = 0;
  for (std::size_t n = 0; n < quality.boundaryValence.counts.size(); ++n)
  {
    points += quality.boundaryValence.counts[n];
    uses += n * quality.boundaryValence.counts[n];
  }
  EXPECT_EQ(points, 2 * (3 * 4 * 4 - 1 * 2 * 2)) << "of two boxes of 2 x 3 x 3 voxels";
  EXPECT_EQ(uses + 24 * quality.valence.counts[24], 4 * mesh.tetrahedra.size());
  EXPECT_GT(quality.boundaryValence.counts[12], 0u) << "a flat boundary of Kuhn's partition halves its 24";
}

TEST(AssessQuality, JSONNamesGroupsAndTissues)
{
  const TetMesh mesh =
    withoutOutside(test::tetrahedraOf(test::paintedMap({ 2, 2, 2 }, [](int i, int, int) { return 3 + i; })));
  const TissueTable tissues{ { 3, { "a \"b\", c", { 0, 0, 0 } } } };
  const MeshQuality quality = assessQuality(mesh, std::vector<std::int32_t>(mesh.tetrahedra.size(), 0), {});
  rapidjson::Document json;
  ASSERT_FALSE(json.Parse(qualityJSON(quality, tissues).c_str()).HasParseError());
  EXPECT_EQ(json["whole"]["tetrahedra"].GetUint64(), mesh.tetrahedra.size());
  ASSERT_EQ(json["tissues"].Size(), 2u);
  EXPECT_STREQ(json["tissues"][0]["name"].GetString(), "a \"b\", c");
  EXPECT_EQ(json["whole"]["edgeOverTarget"]["count"].GetUint64(), 0u);
  EXPECT_TRUE(json["histograms"]["valence"]["counts"].IsArray());
}

} // namespace
} // namespace surgicalmesher
