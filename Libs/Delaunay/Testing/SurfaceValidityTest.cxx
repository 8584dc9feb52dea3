// SPDX-License-Identifier: Apache-2.0
#include "SurfaceValidity.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "Shapes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <set>

namespace surgicalmesher
{
namespace
{

SurfaceRefused refusalOf(const SurfaceComplex& surface)
{
  try
  {
    requireFillable(surface, "file.vtp");
  }
  catch (const SurfaceRefused& refusal)
  {
    return refusal;
  }
  throw std::logic_error("the surface was not refused");
}

/// Each triangle with points of its own, as STL files have them.
SurfaceComplex asSoup(const SurfaceComplex& surface)
{
  SurfaceComplex soup;
  for (const auto& triangle : surface.triangles)
  {
    const auto first = static_cast<std::int32_t>(soup.points.size());
    for (const std::int32_t id : triangle) soup.points.push_back(surface.points[id]);
    soup.triangles.push_back({ first, first + 1, first + 2 });
  }
  return soup;
}

TEST(SelfIntersections, SharedPointsAndEdgesAreNone)
{
  EXPECT_TRUE(selfIntersections(test::sphere({}, 1, 2)).empty());
  EXPECT_TRUE(selfIntersections(test::torus(3, 1, 12, 8)).empty());
  const auto cross = test::paintedMap({ 3, 3, 1 }, [](int i, int j, int) { return 1 + (i + j) % 2; });
  EXPECT_TRUE(selfIntersections(interfaceOf(test::tetrahedraOf(cross))).empty()) << "coplanar neighbours everywhere";
}

TEST(SelfIntersections, FindsEachKind)
{
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, -1 }, { 1, 1, 1 },
                                  { 3, 3, 1 }, { 1, 1, 0 }, { 2, 1, 0 }, { 4, 4, 0 } };
  const auto meet = [&](std::array<std::int32_t, 3> a, std::array<std::int32_t, 3> b) {
    return !selfIntersections({ points, { a, b }, {} }).empty();
  };
  EXPECT_TRUE(meet({ 0, 1, 2 }, { 3, 4, 5 })) << "no common point";
  EXPECT_TRUE(meet({ 0, 1, 2 }, { 0, 3, 4 })) << "a common point, and crossing";
  EXPECT_TRUE(meet({ 0, 1, 2 }, { 0, 6, 7 })) << "a common point, overlapping in the plane";
  EXPECT_TRUE(meet({ 0, 1, 2 }, { 0, 1, 6 })) << "a common edge, folded over";
  EXPECT_FALSE(meet({ 0, 1, 2 }, { 2, 1, 8 })) << "a common edge, side by side in the plane";
  EXPECT_FALSE(meet({ 0, 1, 2 }, { 0, 1, 4 })) << "a common edge, at an angle";
  EXPECT_TRUE(meet({ 0, 1, 2 }, { 1, 0, 2 })) << "the same triangle twice";
}

TEST(RequireFillable, AcceptsSoundSurfaces)
{
  SurfaceComplex nested = test::sphere({}, 4, 2, 1, 0);
  test::append(nested, test::sphere({}, 2, 2, 2, 1));
  EXPECT_NO_THROW(requireFillable(nested, "file.vtp"));
}

TEST(RequireFillable, RefusesAnOpenSurfaceAndShowsWhere)
{
  SurfaceComplex surface = test::sphere({ 50, 60, 70 }, 1, 2);
  surface.triangles.pop_back();
  surface.labels.pop_back();
  const SurfaceRefused refusal = refusalOf(surface);
  const std::string message = refusal.what();
  EXPECT_NE(message.find("file.vtp: the surface of tissue 1 has 3 open edges"), std::string::npos) << message;
  EXPECT_NE(message.find("mm"), std::string::npos);
  ASSERT_EQ(refusal.offending().triangles.size(), 3u) << "the three around the hole";
  for (const Vec3& p : refusal.offending().points) EXPECT_NEAR(norm(p - Vec3{ 50, 60, 70 }), 1, 1e-9);
}

TEST(RequireFillable, RefusesMismatchedLabels)
{
  SurfaceComplex surface = test::sphere({}, 1, 2);
  std::swap(surface.labels[10][0], surface.labels[10][1]);
  EXPECT_NE(std::string(refusalOf(surface).what()).find("mismatched sides"), std::string::npos);
  surface = test::sphere({}, 1, 2);
  surface.labels[10] = { 2, 0 };
  EXPECT_NE(std::string(refusalOf(surface).what()).find("open edges"), std::string::npos);
}

TEST(RequireFillable, RefusesATissueThatTouchesItself)
{
  const auto diagonal = [](bool corner)
  {
    return interfaceOf(test::tetrahedraOf(
      test::paintedMap({ 2, 2, 2 }, [=](int i, int j, int k) { return i == j && (corner ? k == i : k == 0); })));
  };
  const SurfaceRefused edge = refusalOf(diagonal(false)), corner = refusalOf(diagonal(true));
  EXPECT_NE(std::string(edge.what()).find("1 edges of more than two"), std::string::npos) << edge.what();
  EXPECT_EQ(edge.offending().triangles.size(), 4u);
  EXPECT_NE(std::string(corner.what()).find("1 points where parts of it touch"), std::string::npos) << corner.what();
  EXPECT_NE(std::string(corner.what()).find("(0.5, 0.5, 0.5) mm"), std::string::npos) << corner.what();
}

TEST(RequireFillable, RefusesSelfIntersections)
{
  SurfaceComplex surface = test::sphere({}, 1, 2, 1, 0);
  test::append(surface, test::sphere({ 1, 0, 0 }, 1, 2, 2, 0));
  const SurfaceRefused refusal = refusalOf(surface);
  EXPECT_NE(std::string(refusal.what()).find("cuts itself"), std::string::npos) << refusal.what();
  EXPECT_GT(refusal.offending().triangles.size(), 4u);
  EXPECT_LT(refusal.offending().triangles.size(), surface.triangles.size());
}

TEST(RequireFillable, RefusesTrianglesWithoutArea)
{
  SurfaceComplex surface = test::sphere({}, 1, 1);
  const auto& [a, b, c] = surface.triangles[0];
  surface.points[a] = 0.5 * (surface.points[b] + surface.points[c]);
  EXPECT_NE(std::string(refusalOf(surface).what()).find("without area"), std::string::npos);
}

TEST(ClosedShellsToTissues, MergesPointsAndResolvesNesting)
{
  SurfaceComplex shells = test::sphere({}, 8, 3);
  test::append(shells, test::sphere({ 2, 0, 0 }, 4, 2));
  SurfaceComplex turned = test::sphere({ 2, 0, 0 }, 2, 2);
  for (auto& triangle : turned.triangles) std::swap(triangle[0], triangle[1]);
  test::append(shells, turned);
  test::append(shells, test::sphere({ 20, 0, 0 }, 2, 1));
  const SurfaceComplex result = closedShellsToTissues(asSoup(shells), "file.stl");
  EXPECT_EQ(result.points.size(), shells.points.size());
  EXPECT_NO_THROW(requireFillable(result, "file.stl"));
  const auto tissues = checkSurface(result);
  const auto input = checkSurface(shells);
  ASSERT_EQ(tissues.size(), 4u);
  std::set<std::array<Label, 2>> pairs(result.labels.begin(), result.labels.end());
  EXPECT_EQ(pairs, (std::set<std::array<Label, 2>>{ { 1, 0 }, { 2, 1 }, { 3, 2 }, { 4, 0 } }));
  for (const auto& [label, tissue] : tissues)
  {
    EXPECT_TRUE(tissue.manifold()) << label;
    EXPECT_GT(tissue.volume, 0) << label;
  }
}

TEST(ClosedShellsToTissues, MergesPointsThatDifferInTheLastDigits)
{
  const SurfaceComplex torus = test::torus(30, 10, 24, 12);
  SurfaceComplex soup = asSoup(torus);
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    soup.points[i] += 1e-6 * Vec3{ double(i % 3), double(i % 5), double(i % 7) };
  const SurfaceComplex result = closedShellsToTissues(soup, "file.stl");
  EXPECT_EQ(result.points.size(), torus.points.size());
  EXPECT_EQ(checkSurface(result).at(1).euler, 0);
  EXPECT_GT(withoutDuplicatePoints(soup).points.size(), torus.points.size()) << "without a tolerance only equal ones";
}

TEST(ClosedShellsToTissues, TurnsTrianglesThatDisagree)
{
  SurfaceComplex shell = test::torus(3, 1, 12, 8);
  const double volume = checkSurface(shell).at(1).volume;
  for (std::size_t t = 0; t < shell.triangles.size(); t += 3) std::swap(shell.triangles[t][0], shell.triangles[t][1]);
  EXPECT_NEAR(checkSurface(closedShellsToTissues(shell, "file.ply")).at(1).volume, volume, 1e-12);
}

TEST(ClosedShellsToTissues, RefusesWhatIsNoClosedShell)
{
  SurfaceComplex open = test::sphere({}, 1, 2);
  open.triangles.erase(open.triangles.begin() + 7);
  try
  {
    closedShellsToTissues(open, "file.stl");
    FAIL();
  }
  catch (const SurfaceRefused& refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("open"), std::string::npos);
    EXPECT_EQ(refusal.offending().triangles.size(), 3u);
  }
  SurfaceComplex wall =
    interfaceOf(test::tetrahedraOf(test::paintedMap({ 2, 1, 1 }, [](int i, int, int) { return 1 + i; })));
  EXPECT_THROW(closedShellsToTissues(wall, "file.stl"), SurfaceRefused) << "an inner wall needs labels";
  EXPECT_THROW(closedShellsToTissues({ { { 0, 0, 0 }, { 1, 0, 0 } }, { { 0, 1, 1 } }, {} }, "file.stl"), InputError);
}

} // namespace
} // namespace surgicalmesher
