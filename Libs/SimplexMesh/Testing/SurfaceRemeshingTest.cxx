// SPDX-License-Identifier: Apache-2.0
#include "SurfaceRemeshing.h"
#include "MeshChecks.h"
#include "Shapes.h"
#include "SurfaceComparison.h"
#include "SurfaceVolumes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <map>

namespace surgicalmesher
{
namespace
{

RemeshingOptions uniform(double length)
{
  RemeshingOptions options;
  options.edgeLength = [length](const Vec3&) { return length; };
  return options;
}

/// Every tissue is what it was, and has the volume it had but for this share.
void expectSameTissues(const SurfaceComplex& before, const SurfaceComplex& after, double share)
{
  EXPECT_NO_THROW(requireSound(after, "test"));
  const auto wanted = checkSurface(before), found = checkSurface(after);
  ASSERT_EQ(found.size(), wanted.size());
  for (const auto& [label, tissue] : wanted)
  {
    EXPECT_EQ(found.at(label).euler, tissue.euler) << label;
    EXPECT_NEAR(found.at(label).volume / tissue.volume, 1, share) << label;
  }
}

void expectWithin(const SurfaceComplex& before, const SurfaceComplex& after, double mean, double maximum)
{
  for (const SurfaceDistance& distance : { surfaceDistance(before, after), surfaceDistance(after, before) })
  {
    EXPECT_LE(distance.mean, mean);
    EXPECT_LE(distance.maximum, maximum);
  }
}

void expectGoodTriangles(const SurfaceComplex& surface, double length)
{
  const TriangleQuality quality = triangleQuality(surface);
  EXPECT_GE(quality.smallestAngle.minimum, 20);
  EXPECT_GE(quality.smallestAngle.mean, 50);
  EXPECT_LE(quality.edgeVariation, 0.25);
  EXPECT_NEAR(quality.edgeLength.mean / length, 0.95, 0.2);
}

SurfaceComplex ellipsoid(const Vec3& radii, int levels)
{
  SurfaceComplex surface = test::sphere({}, 1, levels);
  for (Vec3& p : surface.points) p = { radii.x * p.x, radii.y * p.y, radii.z * p.z };
  return surface;
}

/// From 0 to 10, with squares of side 1 halved.
SurfaceComplex cube()
{
  constexpr int n = 10;
  SurfaceComplex surface;
  std::map<std::array<int, 3>, std::int32_t> ids;
  const auto point = [&](int axis, int side, int i, int j)
  {
    std::array<int, 3> at{};
    at[axis] = side, at[(axis + 1) % 3] = i, at[(axis + 2) % 3] = j;
    const auto [entry, isNew] = ids.emplace(at, std::int32_t(surface.points.size()));
    if (isNew) surface.points.push_back({ double(at[0]), double(at[1]), double(at[2]) });
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : { 0, n })
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
          const std::int32_t a = point(axis, side, i, j), b = point(axis, side, i + 1, j),
                             c = point(axis, side, i + 1, j + 1), d = point(axis, side, i, j + 1);
          surface.triangles.push_back(side ? std::array{ a, b, c } : std::array{ a, c, b });
          surface.triangles.push_back(side ? std::array{ a, c, d } : std::array{ a, d, c });
        }
  surface.labels.assign(surface.triangles.size(), { Label(1), Label(0) });
  return surface;
}

/// The staircases of a ball of radius 9, cut into tissues 1 and 2, smoothed.
SurfaceComplex halvedBall()
{
  return smoothedBoundary(test::paintedMap({ 22, 22, 22 },
                                           [](int i, int j, int k)
                                           {
                                             const Vec3 p{ i - 10.5, j - 10.5, k - 10.5 };
                                             return norm(p) > 9 ? 0 : p.x + 0.3 * p.y > 0 ? 1 : 2;
                                           }));
}

TEST(SurfaceRemeshing, CoarsensASphere)
{
  const SurfaceComplex before = test::sphere({ 3, 1, 2 }, 10, 4);
  const RemeshedSurface result = remeshSurface(before, uniform(3));
  expectSameTissues(before, result.surface, 0.001);
  expectGoodTriangles(result.surface, 3);
  expectWithin(before, result.surface, 0.1, 0.3);
  EXPECT_EQ(result.sharpEdges, 0u);
  EXPECT_EQ(result.edgeLength.size(), result.surface.points.size());
}

TEST(SurfaceRemeshing, RefinesATorus)
{
  const SurfaceComplex before = test::torus(10, 4, 24, 12);
  const RemeshedSurface result = remeshSurface(before, uniform(1.5));
  expectSameTissues(before, result.surface, 0.005);
  expectGoodTriangles(result.surface, 1.5);
  expectWithin(before, result.surface, 0.1, 0.3);
}

TEST(SurfaceRemeshing, KeepsTheEdgesOfACube)
{
  const SurfaceComplex before = cube();
  for (const double length : { 0.8, 3. })
  {
    const RemeshedSurface result = remeshSurface(before, uniform(length));
    EXPECT_EQ(result.sharpEdges, 120u);
    expectSameTissues(before, result.surface, 1e-9);
    expectWithin(before, result.surface, 1e-9, 1e-9);
    EXPECT_GE(triangleQuality(result.surface).smallestAngle.minimum, 20);
  }
  RemeshingOptions blunt = uniform(3);
  blunt.featureAngle = 180;
  EXPECT_EQ(remeshSurface(before, blunt).sharpEdges, 0u);
}

/// A column of height 10 on a square of side 9.5 whose corners are cut off by a quarter, as contours of voxels are.
SurfaceComplex chamferedColumn()
{
  constexpr int sides = 40, layers = 10, rings = 4;
  constexpr std::array<Vec3, 4> ways{ { { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 } } };
  std::vector<Vec3> outline;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < sides / 4; ++i) outline.push_back((i - 4.5) * ways[side] - 4.75 * ways[(side + 1) % 4]);
  SurfaceComplex surface;
  const auto addRing = [&](double z, double size)
  {
    for (const Vec3& p : outline) surface.points.push_back(size * p + Vec3{ 0, 0, z });
  };
  for (int ring = 1; ring <= rings; ++ring) addRing(0, double(ring) / (rings + 1));
  for (int layer = 0; layer <= layers; ++layer) addRing(layer, 1);
  for (int ring = rings; ring >= 1; --ring) addRing(layers, double(ring) / (rings + 1));
  const auto size = std::int32_t(surface.points.size());
  surface.points.insert(surface.points.end(), { { 0, 0, 0 }, { 0, 0, layers } });
  for (std::int32_t k = 0; k < sides; ++k)
  {
    const std::int32_t next = (k + 1) % sides;
    surface.triangles.push_back({ size, next, k });
    for (std::int32_t from = 0; from < size - sides; from += sides)
    {
      surface.triangles.push_back({ from + k, from + next, from + sides + next });
      surface.triangles.push_back({ from + k, from + sides + next, from + sides + k });
    }
    surface.triangles.push_back({ size - sides + k, size - sides + next, size + 1 });
  }
  surface.labels.assign(surface.triangles.size(), { Label(1), Label(0) });
  return surface;
}

TEST(SurfaceRemeshing, MakesOneEdgeOfAChamfer)
{
  const SurfaceComplex before = chamferedColumn();
  EXPECT_EQ(checkSurface(before).at(1).euler, 2);
  const RemeshedSurface result = remeshSurface(before, uniform(3));
  expectSameTissues(before, result.surface, 0.001);
  expectWithin(before, result.surface, 0.1, 0.6);
  EXPECT_GE(triangleQuality(result.surface).smallestAngle.minimum, 20);
}

TEST(SurfaceRemeshing, KeepsTissuesAndTheCurvesBetweenThem)
{
  const SurfaceComplex before = halvedBall();
  const RemeshedSurface result = remeshSurface(before, uniform(2.5));
  expectSameTissues(before, result.surface, 0.001);
  expectWithin(before, result.surface, 0.2, 0.5);
  EXPECT_LT(4 * result.surface.triangles.size(), before.triangles.size());
  const TriangleQuality quality = triangleQuality(result.surface);
  EXPECT_GE(quality.smallestAngle.minimum, 20);
  EXPECT_GE(quality.smallestAngle.mean, 47);
  const auto& labels = result.surface.labels;
  for (const std::array<Label, 2>& pair : { std::array<Label, 2>{ 1, 0 }, { 2, 0 }, { 2, 1 } })
    EXPECT_GT(std::count(labels.begin(), labels.end(), pair), 10) << pair[0] << " and " << pair[1];
}

TEST(SurfaceRemeshing, HoldsAChordErrorWithFewerTrianglesThanOneLength)
{
  const SurfaceComplex before = ellipsoid({ 18, 6, 6 }, 4);
  RemeshingOptions options = uniform(8);
  options.chordError = 0.15;
  const RemeshedSurface result = remeshSurface(before, options);
  expectSameTissues(before, result.surface, 0.01);
  expectWithin(before, result.surface, 0.15, 0.15);
  const double longestAtTips = std::sqrt(6 * 0.15 * 6 * 6 / 18.);
  EXPECT_LT(1.5 * double(result.surface.triangles.size()),
            double(remeshSurface(before, uniform(longestAtTips)).surface.triangles.size()));
}

TEST(SurfaceRemeshing, IsTheSameWithAnyNumberOfThreads)
{
  const SurfaceComplex before = ellipsoid({ 9, 6, 5 }, 3);
  std::vector<std::vector<Vec3>> points;
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::Initialize(threads);
    points.push_back(remeshSurface(before, uniform(2)).surface.points);
  }
  vtkSMPTools::Initialize(0);
  EXPECT_TRUE(points[0] == points[1]);
}

TEST(SharpEdges, AreThoseOfBodiesAndNotOfVoxels)
{
  const auto length = [](const Vec3&) { return 2.; };
  EXPECT_EQ(sharpEdges(cube(), 40, length).size(), 120u);
  EXPECT_TRUE(sharpEdges(cube(), 91, length).empty());
  EXPECT_TRUE(sharpEdges(test::sphere({}, 10, 3), 40, length).empty());
  const auto longer = [](const Vec3&) { return 4.; };
  EXPECT_EQ(sharpEdges(halvedBall(), 40, longer).size(), 0u);
}

/// The staircases of a ball of radius 6 and of what it leaves of another, smoothed.
SurfaceComplex twoBalls()
{
  return smoothedBoundary(test::paintedMap({ 26, 18, 18 },
                                           [](int i, int j, int k)
                                           {
                                             const Vec3 p{ i - 8.5, j - 8.5, k - 8.5 };
                                             return norm(p) < 6 ? 1 : norm(p - Vec3{ 8, 0, 0 }) < 6 ? 2 : 0;
                                           }));
}

TEST(SurfaceVolumes, DisplacementsAddWhatIsLackingToEachTissue)
{
  SurfaceComplex surface = twoBalls();
  const std::map<Label, double> before = enclosedVolumes(surface);
  ASSERT_EQ(before.size(), 2u);
  EXPECT_NEAR(before.at(1), checkSurface(surface).at(1).volume, 1e-6);
  std::vector<double> mobility(surface.points.size(), 1);
  mobility[3] = 0;
  const std::vector<Vec3> ways = displacementsForVolumes(surface, { { 1, 4. }, { 2, -7. } }, mobility);
  EXPECT_TRUE(ways[3] == Vec3());
  for (std::size_t p = 0; p < ways.size(); ++p) surface.points[p] += ways[p];
  const std::map<Label, double> after = enclosedVolumes(surface);
  EXPECT_NEAR(after.at(1), before.at(1) + 4, 0.1);
  EXPECT_NEAR(after.at(2), before.at(2) - 7, 0.1);
}

TEST(SurfaceComparison, MeasuresSpheres)
{
  const SurfaceComplex inner = test::sphere({}, 10, 4), outer = test::sphere({}, 11, 4);
  const SurfaceDistance distance = surfaceDistance(outer, inner);
  EXPECT_NEAR(distance.mean, 1, 0.02);
  EXPECT_NEAR(distance.maximum, 1, 0.05);
  EXPECT_NEAR(surfaceDistance(inner, inner).maximum, 0, 1e-12);
  EXPECT_LT(triangleQuality(inner).smallestAngle.minimum, 60);
}

} // namespace
} // namespace surgicalmesher
