// SPDX-License-Identifier: Apache-2.0
#include "Balloon.h"
#include "EnclosedVoxels.h"
#include "Errors.h"
#include "MeshChecks.h"
#include "Shapes.h"
#include "SharedInterface.h"
#include "SimplexMesh.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <set>

namespace surgicalmesher
{
namespace
{

constexpr Label wall = 1, balloon = 5;

/// Of a cubic map of `size` voxels, by the place relative to its centre.
TissueMap mapOf(int size, const std::function<bool(const Vec3&)>& isWall)
{
  const double c = 0.5 * (size - 1);
  return test::paintedMap({ size, size, size },
                          [&](int i, int j, int k) {
                            return isWall({ i - c, j - c, k - c }) ? wall : 0;
                          });
}

Vec3 centreOf(const TissueMap& map) { return 0.5 * (map.grid.size[0] - 1) * Vec3{ 1, 1, 1 }; }

BalloonOptions uniform(double length)
{
  BalloonOptions options;
  options.edgeLength = [length](const Vec3&) { return length; };
  return options;
}

BalloonResult grow(const TissueMap& map, const std::vector<BalloonSeed>& seeds, const BalloonOptions& options)
{
  return growBalloons(seeds, StoppingField(map, { wall }, 0.5 * options.rigidity + 1), options);
}

/// Closed, connected and of genus 0.
void expectSphere(const SurfaceComplex& surface)
{
  EXPECT_NO_THROW(simplexMeshOf(surface));
  EXPECT_EQ(int(surface.points.size()) - int(surface.triangles.size()) / 2, 2);
}

/// A shell three voxels thick around a ball of radius 17, with a hole towards +z.
TissueMap shell(double hole)
{
  return mapOf(47,
               [=](const Vec3& p)
               {
                 const double r = norm(p);
                 return r > 17 && r <= 20 && !(p.z > 0 && std::hypot(p.x, p.y) <= 0.5 * hole);
               });
}

TEST(Balloon, FillsABallFromOffItsCentre)
{
  const TissueMap map = mapOf(36, [](const Vec3& p) { return norm(p) > 14; });
  const BalloonResult result = grow(map, { { centreOf(map) + Vec3{ 4, 3, -2 }, balloon } }, uniform(2));
  expectSphere(result.surface);
  EXPECT_TRUE(result.isAtRest);
  EXPECT_LE(result.evolution.back().motion, 1300);
  EXPECT_GE(result.evolution.back().withinTolerance, 0.9);
  for (const Vec3& p : result.surface.points) EXPECT_NEAR(norm(p - centreOf(map)), 14, 0.5);
  EXPECT_EQ(result.halts.at(balloon).tissue, result.surface.points.size());
  EXPECT_GT(result.evolution.back().volume, 0.97 * 4 / 3 * std::acos(-1.) * 14 * 14 * 14);
}

TEST(Balloon, ClosesOverAHoleWhateverTheEdgeLength)
{
  const TissueMap holed = shell(8), whole = shell(0);
  const Vec3 centre = centreOf(holed), seed = centre + Vec3{ 3, 2, -4 };
  double voxels = 0; // of the ball inside
  for (std::size_t n = 0; n < whole.labels.size(); ++n)
  {
    const auto [i, j, k] = whole.grid.voxelAt(n);
    voxels += norm(whole.grid.position(i, j, k) - centre) <= 17;
  }
  for (const double length : { 1.5, 2.5 })
  {
    const BalloonResult result = grow(holed, { { seed, balloon } }, uniform(length));
    const BalloonResult closed = grow(whole, { { seed, balloon } }, uniform(length));
    expectSphere(result.surface);
    EXPECT_TRUE(result.isAtRest);
    for (const Vec3& p : result.surface.points) EXPECT_LT(norm(p - centre), 17 + 2) << length;
    EXPECT_NEAR(result.evolution.back().volume / voxels, 1, 0.01) << length;
    EXPECT_NEAR(result.evolution.back().volume / closed.evolution.back().volume, 1, 0.005) << length;
    EXPECT_GT(result.halts.at(balloon).rigidity, 0u);
    EXPECT_EQ(result.halts.at(balloon).end, 0u);
  }
}

TEST(Balloon, LeavesByAHoleThatIsWiderThanItsRigidityAndStopsAtTheLimit)
{
  const TissueMap map = shell(14);
  const Vec3 centre = centreOf(map);
  BalloonOptions options = uniform(2.5);
  options.rigidity = 3;
  options.limit = 22;
  const BalloonResult result = grow(map, { { centre, balloon } }, options);
  expectSphere(result.surface);
  EXPECT_GT(result.halts.at(balloon).limit, 0u);
  for (const Vec3& p : result.surface.points) EXPECT_LT(norm(p - centre), 22.5);
}

TEST(Balloon, TwoThatMeetDoNotCrossAndShareOneInterface)
{
  const TissueMap map = mapOf(30, [](const Vec3& p) { return std::hypot(p.y, p.z) > 8; });
  const Vec3 c = centreOf(map);
  const BalloonResult result =
    grow(map, { { c - Vec3{ 6, 0, 0 }, balloon }, { c + Vec3{ 6, 0, 0 }, Label(balloon + 1) } }, uniform(2));
  std::set<std::size_t> seen;
  std::size_t count = 0;
  for (const Label label : { balloon, Label(balloon + 1) })
  {
    const auto voxels = enclosedVoxels(result.surface, label, map.grid);
    seen.insert(voxels.begin(), voxels.end());
    count += voxels.size();
    EXPECT_GT(result.halts.at(label).neighbour, 0u);
    EXPECT_GT(result.halts.at(label).end, 0u);
  }
  EXPECT_EQ(seen.size(), count);
  const auto free = std::count(map.labels.begin(), map.labels.end(), Label(0));
  EXPECT_GT(double(count), 0.9 * double(free));

  std::vector<bool> isFree;
  for (const Label label : map.labels) isFree.push_back(label != wall);
  const SurfaceComplex joined =
    withSharedInterfaces(result.surface, map.grid, isFree, 4, [](const Vec3&) { return 2.; });
  EXPECT_NO_THROW(requireSound(joined, "test"));
  const auto tissues = checkSurface(joined);
  ASSERT_EQ(tissues.size(), 2u);
  for (const auto& [label, tissue] : tissues) EXPECT_EQ(tissue.euler, 2);
  double shared = 0;
  for (std::size_t t = 0; t < joined.triangles.size(); ++t)
  {
    const auto& [a, b, c3] = joined.triangles[t];
    const Vec3 &p = joined.points[a], &q = joined.points[b], &r = joined.points[c3];
    if (joined.labels[t][0] == 0 || joined.labels[t][1] == 0) continue;
    EXPECT_NEAR(p.x, c.x, 2.5);
    shared += 0.5 * norm(cross(q - p, r - p));
  }
  EXPECT_NEAR(shared / (std::acos(-1.) * 64), 1, 0.15);
  EXPECT_NEAR((tissues.at(balloon).volume + tissues.at(balloon + 1).volume) / double(free), 1, 0.05);
}

TEST(Balloon, TwoThatMeetTakeNothingBeyondTheWall)
{
  const auto outside = [](const Vec3& p) { return std::min(norm(p - Vec3{ 6.5, 0, 0 }), norm(p + Vec3{ 6.5, 0, 0 })); };
  const auto isInNeck = [](const Vec3& p) { return std::abs(p.x) < 6.5 && std::hypot(p.y, p.z) < 4; };
  const TissueMap map = mapOf(36, [&](const Vec3& p) { return outside(p) >= 6 && outside(p) < 8 && !isInNeck(p); });
  const Vec3 c = centreOf(map);
  BalloonOptions options = uniform(2.4);
  options.rigidity = 5.5;
  const BalloonResult result =
    grow(map, { { c + Vec3{ 6.5, 0, 0 }, balloon }, { c - Vec3{ 6.5, 0, 0 }, Label(balloon + 1) } }, options);
  std::vector<bool> isFree;
  for (const Label label : map.labels) isFree.push_back(label != wall);
  const SurfaceComplex joined = withSharedInterfaces(result.surface, map.grid, isFree, 4.8, options.edgeLength);
  for (const auto& [label, tissue] : checkSurface(joined))
  {
    EXPECT_EQ(tissue.euler, 2) << label;
    for (const std::size_t voxel : enclosedVoxels(joined, label, map.grid))
    {
      const auto [i, j, k] = map.grid.voxelAt(voxel);
      EXPECT_LT(outside(map.grid.position(i, j, k) - c), 8) << label;
    }
  }
}

TEST(Balloon, IsTheSameWithAnyNumberOfThreads)
{
  const TissueMap map = mapOf(24, [](const Vec3& p) { return norm(p) > 9; });
  std::vector<std::vector<Vec3>> points;
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::Initialize(threads);
    points.push_back(grow(map, { { centreOf(map), balloon } }, uniform(2)).surface.points);
  }
  vtkSMPTools::Initialize(0);
  EXPECT_TRUE(points[0] == points[1]);
}

TEST(Balloon, FillsWhatIsNarrowerThanItsRigidityAndWhatItBeginsAtTheWallOf)
{
  const TissueMap small = mapOf(16, [](const Vec3& p) { return norm(p) > 4; });
  const BalloonResult inSmall = grow(small, { { centreOf(small), balloon } }, uniform(1.5));
  for (const Vec3& p : inSmall.surface.points) EXPECT_NEAR(norm(p - centreOf(small)), 4, 0.7);
  const TissueMap large = mapOf(30, [](const Vec3& p) { return norm(p) > 12; });
  const BalloonResult inLarge = grow(large, { { centreOf(large) + Vec3{ 10.5, 0, 0 }, balloon } }, uniform(2));
  for (const Vec3& p : inLarge.surface.points) EXPECT_NEAR(norm(p - centreOf(large)), 12, 0.7);
}

TEST(Balloon, RefusesSeedsWithoutRoom)
{
  const TissueMap map = mapOf(24, [](const Vec3& p) { return norm(p) > 9; });
  const Vec3 c = centreOf(map);
  EXPECT_THROW(grow(map, { { c + Vec3{ 10, 0, 0 }, balloon } }, uniform(2)), InputError);
  EXPECT_THROW(grow(map, { { Vec3{ -3, 2, 2 }, balloon } }, uniform(2)), InputError);
  EXPECT_THROW(grow(map, { { c, balloon }, { c + Vec3{ 0.5, 0, 0 }, Label(6) } }, uniform(2)), InputError);
}

TEST(BendingForces, SpareSpheresAndFlattenBumps)
{
  SurfaceComplex surface = test::sphere({}, 10, 3);
  const std::vector<double> widths(surface.points.size(), 3);
  const auto inwards = [&](Continuity continuity, std::size_t p)
  { return -dot(bendingForces(surface, continuity, widths)[p], surface.points[p]) / 10; };
  for (std::size_t p = 0; p < surface.points.size(); p += 17)
  {
    EXPECT_EQ(inwards(Continuity::C0, p), 0);
    EXPECT_NEAR(inwards(Continuity::C1, p), 0.9, 0.3) << "width^2 / radius";
    EXPECT_NEAR(inwards(Continuity::C2, p), 0, 0.2) << "but for uneven edges, all of a sphere is bent alike";
  }
  surface.points[0] = 1.2 * surface.points[0];
  EXPECT_GT(inwards(Continuity::C2, 0), 0.5);
  surface.points[0] = 0.7 * surface.points[0];
  EXPECT_LT(inwards(Continuity::C2, 0), -0.5);
}

TEST(StoppingField, SaysHowFarTheWallIs)
{
  TissueMap map = test::paintedMap({ 20, 12, 12 }, [](int i, int, int) { return i < 12 ? 0 : int(wall); });
  map.grid.spacing = { 1, 0.5, 2 };
  const StoppingField field(map, { wall }, 4);
  const Vec3 x{ 1, 0, 0 };
  for (const double from : { 10.2, 11.0, 11.45, 11.6, 12.4 })
  {
    const Vec3 p{ from, 3, 9 };
    EXPECT_EQ(field.stops(p), from > 11.5);
    if (std::abs(from - 11.5) < field.reach())
    {
      EXPECT_NEAR(field.wayToTissue(p, x), 11.5 - from, 0.05);
    }
  }
  EXPECT_EQ(field.wayToTissue({ 5, 3, 9 }, x), field.reach());
  EXPECT_NEAR(field.wayToEnd({ 5, 3, 9 }, { 0, 1, 0 }), 5.75 - 3, 1e-9);
  EXPECT_NEAR(field.wayToEnd({ 5, 3, 9 }, { 0, 0, -1 }), 1 + 9, 1e-9);
  EXPECT_TRUE(field.stops({ 5, 6, 9 })) << "beyond the map";
  EXPECT_NEAR(field.clearance({ 9, 3, 9 }), 12 - 9 - 0.25, 1e-6)
    << "to the voxel's centre, less half its smallest side";
  EXPECT_EQ(field.clearance({ 2, 3, 9 }), 4);
}

TEST(EnclosedVoxels, AreThoseWithTheirCentreInside)
{
  Grid grid;
  grid.size = { 24, 22, 13 };
  grid.spacing = { 1, 1, 2 };
  const Vec3 centre{ 11, 10, 12 }; // a voxel's: rows pass through points of the surface
  const SurfaceComplex surface = test::sphere(centre, 8, 3, balloon);
  const std::vector<std::size_t> voxels = enclosedVoxels(surface, balloon, grid);
  const std::set<std::size_t> inside(voxels.begin(), voxels.end());
  ASSERT_EQ(inside.size(), voxels.size());
  for (std::size_t n = 0; n < grid.voxelCount(); ++n)
  {
    const auto [i, j, k] = grid.voxelAt(n);
    const double r = norm(grid.position(i, j, k) - centre);
    if (r < 7.85)
    {
      EXPECT_EQ(inside.count(n), 1u);
    }
    if (r > 8.001)
    {
      EXPECT_EQ(inside.count(n), 0u);
    }
  }
  EXPECT_TRUE(enclosedVoxels(surface, 7, grid).empty());
}

} // namespace
} // namespace surgicalmesher
