// SPDX-License-Identifier: Apache-2.0
#include "TissueMesher.h"
#include "DigitalTopology.h"
#include "FaceAdjacency.h"
#include "MapPreparation.h"
#include "MeshChecks.h"
#include "MeshedMapChecks.h"
#include "RandomMaps.h"
#include "ScaleMaps.h"
#include "TissueMapIO.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace surgicalmesher
{
namespace
{

using namespace test;

/// Labels at the cubes of `size` voxels from (low) on; the grid stays where it was in the world.
TissueMap cropped(const TissueMap& map, const std::array<int, 3>& low, const std::array<int, 3>& size)
{
  TissueMap part = map;
  part.grid.size = size;
  part.grid.origin =
    map.grid.gridToWorld({ low[0] * map.grid.spacing.x, low[1] * map.grid.spacing.y, low[2] * map.grid.spacing.z });
  part.labels.resize(part.grid.voxelCount());
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
        part.labels[part.grid.index(i, j, k)] = map.labels[map.grid.index(low[0] + i, low[1] + j, low[2] + k)];
    }
  }
  return part;
}

TissueMap atlasPart()
{
  TissueMap map = cropped(readTissueMap("/usr/share/mricron/templates/jhu189.nii.gz"), { 55, 70, 30 }, { 64, 64, 64 });
  prepareMap(map, {});
  return map;
}

double squareAt(int i, int j, int k, const Vec3& centre)
{
  return squaredNorm(Vec3{ double(i), double(j), double(k) } - centre);
}

struct Shape
{
  std::string name;
  TissueMap map;
};

std::vector<Shape> shapes()
{
  const Vec3 middle{ 8, 8, 8 };
  const auto within = [](int x, int low, int high) { return low <= x && x <= high; };
  std::mt19937 random(1);
  TissueMap noise = paintedMap({ 10, 10, 10 }, [&](int, int, int) { return int(random() % 3); });
  TissueMap checkerboard = paintedMap({ 8, 8, 8 }, [](int i, int j, int k) { return 1 + ((i + j + k) & 1); });
  std::vector<Shape> shapes{
    { "sphere", paintedMap({ 17, 17, 17 }, [=](int i, int j, int k) { return squareAt(i, j, k, middle) <= 49; }) },
    { "torus", paintedMap({ 21, 21, 9 },
                          [](int i, int j, int k)
                          {
                            const double r = std::hypot(i - 10, j - 10) - 6.5;
                            return r * r + (k - 4) * (k - 4) <= 7;
                          }) },
    { "nested spheres", paintedMap({ 17, 17, 17 },
                                   [=](int i, int j, int k)
                                   {
                                     const double r = squareAt(i, j, k, middle);
                                     return r <= 4 ? 0 : r <= 16 ? 3 : r <= 36 ? 2 : r <= 56 ? 1 : 0;
                                   }) },
    { "two touching cubes",
      paintedMap({ 14, 8, 8 }, [=](int i, int j, int k)
                 { return within(j, 2, 5) && within(k, 2, 5) && within(i, 2, 11) ? 1 + (i > 6) : 0; }) },
    { "slab of one voxel", paintedMap({ 16, 16, 5 }, [](int, int, int k) { return k == 2; }) },
    { "voxel", paintedMap({ 3, 3, 3 }, [](int i, int j, int k) { return i == 1 && j == 1 && k == 1; }) },
    { "voxel that is all", paintedMap({ 1, 1, 1 }, [](int, int, int) { return 5; }) },
    { "three tissues around a curve",
      paintedMap({ 14, 14, 10 }, [](int i, int j, int) { return i < 7   ? 1
                                                                : j < 7 ? 2
                                                                        : 3; }) },
    { "tissue cut by the border",
      paintedMap({ 9, 17, 17 }, [=](int i, int j, int k) { return squareAt(i + 8, j, k, middle) <= 49; }) },
    { "one label everywhere", paintedMap({ 12, 9, 7 }, [](int, int, int) { return 9; }) },
    { "slices",
      paintedMap({ 15, 15, 7 },
                 [](int i, int j, int k) { return std::hypot(0.98 * (i - 7), 0.98 * (j - 7), 2.5 * (k - 3)) <= 6; },
                 { 0.98, 0.98, 2.5 }) },
    { "noise", noise },
    { "checkerboard", checkerboard },
  };
  for (Shape& shape : shapes) prepareMap(shape.map, {});
  return shapes;
}

MeshedMap meshed(const TissueMap& map, const ScaleField& scale) { return meshTissues(map, scale, {}); }

MeshedMap meshedInSteps(const TissueMap& map, const ScaleField& scale)
{
  TissueMesherOptions options;
  options.smoothing = options.rigidity = 0;
  return meshTissues(map, scale, options);
}

/// Mean angle, degrees, between the normals of neighbouring triangles, weighted by the edges' lengths.
double meanDeflection(const SurfaceComplex& surface)
{
  std::map<std::array<std::int32_t, 2>, Vec3> first; // normal of the first triangle at an edge
  double sum = 0, length = 0;
  for (const auto& t : surface.triangles)
  {
    const auto& p = surface.points;
    const Vec3 across = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), normal = across / norm(across);
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = t[k], b = t[(k + 1) % 3];
      const auto [at, isFirst] = first.insert({ { std::min(a, b), std::max(a, b) }, normal });
      if (isFirst) continue;
      const double edge = norm(p[a] - p[b]);
      sum += edge * std::acos(std::clamp(dot(at->second, normal), -1.0, 1.0)) * 180 / M_PI;
      length += edge;
    }
  }
  return sum / length;
}

void expectSameBytes(const MeshedMap& a, const MeshedMap& b)
{
  EXPECT_EQ(a.background.mesh.points, b.background.mesh.points);
  EXPECT_EQ(a.background.mesh.tetrahedra, b.background.mesh.tetrahedra);
  EXPECT_EQ(a.background.mesh.labels, b.background.mesh.labels);
  EXPECT_EQ(a.background.lengths, b.background.lengths);
}

/// The map with axes turned and flipped in memory, in the same place of the world: axis a of the copy runs along axis
/// order[a] of the map, backwards if flips[a].
TissueMap rearranged(const TissueMap& map, const std::array<int, 3>& order, const std::array<bool, 3>& flips)
{
  TissueMap copy;
  const Grid& from = map.grid;
  Vec3 first;
  for (int a = 0; a < 3; ++a)
  {
    copy.grid.size[a] = from.size[order[a]];
    copy.grid.spacing[a] = from.spacing[order[a]];
    copy.grid.axes[a] = flips[a] ? -from.axes[order[a]] : from.axes[order[a]];
    if (flips[a]) first[order[a]] = (from.size[order[a]] - 1) * from.spacing[order[a]];
  }
  copy.grid.origin = from.gridToWorld(first);
  for (int k = 0; k < copy.grid.size[2]; ++k)
  {
    for (int j = 0; j < copy.grid.size[1]; ++j)
    {
      for (int i = 0; i < copy.grid.size[0]; ++i)
      {
        std::array<int, 3> at;
        for (int a = 0; a < 3; ++a)
        {
          const int x = std::array<int, 3>{ i, j, k }[a];
          at[order[a]] = flips[a] ? copy.grid.size[a] - 1 - x : x;
        }
        copy.labels.push_back(map.labels[from.index(at[0], at[1], at[2])]);
      }
    }
  }
  return copy;
}

} // namespace

class MeshedShape : public ::testing::TestWithParam<double>
{
};

TEST_P(MeshedShape, IsSoundAndHasTheMapsTopology)
{
  for (const Shape& shape : shapes())
  {
    SCOPED_TRACE(shape.name);
    if (GetParam() < 1 && shape.map.labels.size() > 1000) continue; // millions of tetrahedra
    const MeshedMap mesh = meshed(shape.map, uniformScale(GetParam()));
    EXPECT_EQ(faultOf(mesh, shape.map), "");
    ASSERT_FALSE(mesh.evolution.empty());
    EXPECT_GT(mesh.evolution.front().faces, 0u);
    EXPECT_EQ(mesh.evolution.back().tetrahedra, withoutOutside(mesh.background.mesh).tetrahedra.size());
    if (GetParam() != 1.5) continue;
    EXPECT_EQ(faultOf(meshedInSteps(shape.map, uniformScale(GetParam())), shape.map), "");
  }
}

INSTANTIATE_TEST_SUITE_P(BelowAtAndAboveTheVoxel, MeshedShape, ::testing::Values(0.7, 1.5, 4.0, 30.0));

TEST(SurfaceMesher, FollowsASphereAtItsScale)
{
  const TissueMap map = shapes()[0].map;
  for (double length : { 1.5, 3.0 })
  {
    const SurfaceComplex surface = interfaceOf(meshed(map, uniformScale(length)).background.mesh);
    const double voxels = double(std::count(map.labels.begin(), map.labels.end(), 1));
    EXPECT_NEAR(checkSurface(surface).at(1).volume, voxels, 0.05 * voxels) << length;
    for (const Vec3& p : surface.points) EXPECT_NEAR(norm(p - Vec3{ 8, 8, 8 }), 7.1, 0.45 + 0.11 * length + 0.5);
  }
}

TEST(SurfaceMesher, HasNoStepsWhereLIsAVoxel)
{
  const TissueMap map = shapes()[0].map;
  for (double length : { 1.0, 1.5, 2.0 })
  {
    const double steps = meanDeflection(interfaceOf(meshedInSteps(map, uniformScale(length)).background.mesh));
    const SurfaceComplex smooth = interfaceOf(meshed(map, uniformScale(length)).background.mesh);
    EXPECT_LT(meanDeflection(smooth), (length < 1.5 ? 0.5 : 0.85) * steps) << length;
  }
}

/// A box of so many voxels along each axis has no vertex farther off its walls, their edges apart, than a fifth of a voxel.
void expectFlatWalls(int side, double length)
{
  constexpr double low = 3.5, away = 3; // of the walls; from their edges
  const double high = low + side;
  TissueMap map = paintedMap({ side + 8, side + 8, side + 8 },
                             [=](int i, int j, int k)
                             {
                               const auto isIn = [=](int x) { return x > low && x < high; };
                               return isIn(i) && isIn(j) && isIn(k);
                             });
  prepareMap(map, {});
  const MeshedMap mesh = meshed(map, uniformScale(length));
  EXPECT_EQ(faultOf(mesh, map), "") << side << " " << length;
  int count = 0;
  double farthest = 0;
  for (const Vec3& p : interfaceOf(mesh.background.mesh).points)
    for (int a = 0; a < 3; ++a)
    {
      const double off = std::min(std::abs(p[a] - low), std::abs(p[a] - high));
      const auto isAmid = [&](double x) { return x > low + away && x < high - away; };
      if (off > 2 || !isAmid(p[(a + 1) % 3]) || !isAmid(p[(a + 2) % 3])) continue;
      ++count;
      farthest = std::max(farthest, off);
    }
  EXPECT_GT(count, 2.5 * side * side / (length * length)) << side << " " << length;
  EXPECT_LT(farthest, 0.2) << side << " " << length;
}

/// Between samples a voxel apart every vertex is far from the nearest one, and is no spike; a vertex of a wall with few
/// tetrahedra behind it is no ear.
TEST(SurfaceMesher, LeavesFlatWallsFlatWhereLIsAboutAVoxel)
{
  for (const double length : { 1.0, 1.25, 1.75, 2.0 }) expectFlatWalls(20, length);
  // Where repairs have pulled a single vertex out, it goes back.
  for (const double length : { 1.25, 2.25 }) expectFlatWalls(32, length);
}

/// What noise lifts off a curved wall is no ear either.
TEST(SurfaceMesher, HasNoDentsInABall)
{
  constexpr double radius = 20, middle = 23;
  TissueMap map = paintedMap({ 47, 47, 47 },
                             [](int i, int j, int k) {
                               return squaredNorm(Vec3{ i - middle, j - middle, k - middle }) < radius * radius;
                             });
  prepareMap(map, {});
  for (const double length : { 1.0, 2.0 })
  {
    double farthest = 0;
    for (const Vec3& p : interfaceOf(meshed(map, uniformScale(length)).background.mesh).points)
      farthest = std::max(farthest, std::abs(norm(p - Vec3{ middle, middle, middle }) - radius));
    EXPECT_LT(farthest, 0.4) << length;
  }
}

TEST(SurfaceMesher, ResistsBendingAtTheTopologyOfTheMap)
{
  for (const Shape& shape : shapes())
  {
    TissueMesherOptions options;
    options.rigidity = 0;
    const double soft = meanDeflection(interfaceOf(meshTissues(shape.map, uniformScale(2), options).background.mesh));
    options.rigidity = 0.5;
    const MeshedMap rigid = meshTissues(shape.map, uniformScale(2), options);
    EXPECT_EQ(faultOf(rigid, shape.map), "") << shape.name;
    // A slab or a voxel is all edges.
    if (shape.name == "noise")
    {
      EXPECT_LT(meanDeflection(interfaceOf(rigid.background.mesh)), soft);
    }
  }
}

TEST(SurfaceMesher, KeepsTheVolumeOfTissuesSmallerThanL)
{
  const Vec3 middle{ 20, 20, 20 };
  const TissueMap map = paintedMap({ 41, 41, 41 },
                                   [&](int i, int j, int k)
                                   {
                                     const double square = squareAt(i, j, k, middle);
                                     return square < 3.6 * 3.6 ? 2 : square < 18 * 18 ? 1 : 0;
                                   });
  const double voxels = double(std::count(map.labels.begin(), map.labels.end(), 2));
  for (const double length : { 10.0, 14.0, 20.0 })
  {
    const MeshedMap mesh = meshed(map, uniformScale(length));
    EXPECT_EQ(faultOf(mesh, map), "") << length;
    EXPECT_NEAR(checkSurface(interfaceOf(mesh.background.mesh)).at(2).volume, voxels, 0.1 * voxels) << length;
  }
}

TEST(SurfaceMesher, KeepsTheDistanceAskedFor)
{
  const TissueMap map = shapes()[2].map;
  TissueMesherOptions options;
  options.maximumDistance = 0.4;
  const MeshedMap mesh = meshTissues(map, uniformScale(3), options);
  EXPECT_EQ(faultOf(mesh, map), "");
  for (const auto& e : mesh.background.samples) EXPECT_LE(e.tolerance, 0.4f);
  EXPECT_LE(mesh.evolution.back().maximumDistance, std::max(0.4, mesh.evolution.front().maximumDistance) * (1 + 1e-6));
}

TEST(SurfaceMesher, HoldsThinTissuesLessCloselyOnceSimplifiedUnlessProtected)
{
  const TissueMap map = paintedMap({ 12, 12, 12 }, [](int, int, int k) { return k < 3 ? 1 : 2; });
  const auto mostDrift = [&](const FeatureOptions& features)
  {
    TissueMesherOptions options;
    options.smoothing = 0;
    options.features = features;
    float most = 0;
    for (const auto& e : meshTissues(map, uniformScale(9), options).background.samples)
      if (e.position.z < 2.7) most = std::max(most, e.tolerance);
    return most;
  };
  const float usual = mostDrift({});
  EXPECT_LT(usual, 1.f); // not as far as L allows
  EXPECT_FLOAT_EQ(mostDrift({ 0.5, {} }), usual * 0.32f / 0.28f);
  EXPECT_FLOAT_EQ(mostDrift({ 9, {} }), usual * 0.4f / 0.28f);
  EXPECT_FLOAT_EQ(mostDrift({ 0.5, { 1 } }), usual);
}

TEST(SurfaceMesher, EveryTissueOfAnAtlasIsAsInTheMap)
{
  const TissueMap map = atlasPart();
  ASSERT_GT(presentLabels(map).size(), 20u);
  const ScaleField scale = radialScale(map.grid, map.grid.gridToWorld({ 32, 32, 32 }), 1, 8, 10, 25);
  const MeshedMap mesh = meshed(map, scale);
  EXPECT_EQ(faultOf(mesh, map), "");
  const auto tissues = checkSurface(interfaceOf(mesh.background.mesh));
  EXPECT_EQ(tissues.size(), presentLabels(map).size());
}

TEST(SurfaceMesher, BytesDoNotDependOnThreads)
{
  TissueMap map = cropped(atlasPart(), { 16, 16, 16 }, { 32, 32, 32 });
  prepareMap(map, {}); // the cut makes new contacts with the outside
  const ScaleField scale = radialScale(map.grid, map.grid.gridToWorld({ 16, 16, 16 }), 1, 6, 4, 12);
  vtkSMPTools::Initialize(1);
  const MeshedMap alone = meshed(map, scale);
  vtkSMPTools::Initialize(2);
  expectSameBytes(meshed(map, scale), alone);
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(faultOf(alone, map), "");
}

TEST(SurfaceMesher, AMapsAxesDoNotMatter)
{
  TissueMap map = cropped(atlasPart(), { 24, 24, 24 }, { 20, 16, 18 });
  prepareMap(map, {});
  const MeshedMap expected = meshed(map, uniformScale(2.5));
  const auto file = std::filesystem::temp_directory_path() / "surgicalmesher-axes.nrrd";
  const std::vector<std::pair<std::array<int, 3>, std::array<bool, 3>>> arrangements{
    { { 1, 2, 0 }, { false, false, false } },
    { { 0, 1, 2 }, { true, true, false } },
    { { 1, 0, 2 }, { false, false, true } },
    { { 2, 1, 0 }, { true, true, true } },
  };
  for (const auto& [order, flips] : arrangements)
  {
    writeTissueMap(rearranged(map, order, flips), file.string());
    const TissueMap read = readTissueMap(file.string());
    ASSERT_EQ(read.labels, map.labels);
    EXPECT_LT(norm(read.grid.origin - map.grid.origin), 1e-6);
    expectSameBytes(meshed(read, uniformScale(2.5)), expected);
  }
  std::filesystem::remove(file);
}

TEST(SurfaceMesher, AMapsPlaceDoesNotMatter)
{
  TissueMap map = cropped(atlasPart(), { 24, 24, 24 }, { 20, 16, 18 });
  prepareMap(map, {});
  const ScaleField scale = radialScale(map.grid, map.grid.gridToWorld({ 5, 6, 7 }), 1, 5, 3, 8);
  TissueMap turned = map;
  const double c = std::cos(0.4), s = std::sin(0.4);
  turned.grid.axes = { Vec3{ c, s, 0 }, Vec3{ -s * c, c * c, s }, Vec3{ s * s, -c * s, c } };
  turned.grid.origin = { 101, -57, 33 };
  ScaleField turnedScale = scale;
  turnedScale.grid.axes = turned.grid.axes;
  turnedScale.grid.origin = turned.grid.gridToWorld(map.grid.worldToGrid(scale.grid.origin));
  expectSameBytes(meshed(turned, uniformScale(2.5)), meshed(map, uniformScale(2.5)));

  // A graded scale is read in the world, with rounding, unless both are brought to the frame of the map.
  const auto meshedInOwnFrame = [](TissueMap m, const ScaleField& scaleInWorld)
  {
    const ScaleField own = inFrameOf(m.grid, scaleInWorld);
    m.grid = inOwnFrame(m.grid);
    return meshed(m, own);
  };
  expectSameBytes(meshedInOwnFrame(turned, turnedScale), meshedInOwnFrame(map, scale));
}

TEST(SurfaceMesher, CanBeCancelledAnywhere)
{
  const TissueMap map = shapes()[2].map;
  struct Cancelled
  {
  };
  double last = -1;
  std::vector<double> fractions;
  meshTissues(map, uniformScale(2), {},
              [&](double fraction, const std::string& stage)
              {
                EXPECT_GE(fraction, last);
                EXPECT_LE(fraction, 1);
                EXPECT_FALSE(stage.empty());
                last = fraction;
                fractions.push_back(fraction);
              });
  ASSERT_GT(fractions.size(), 5u);
  for (std::size_t at = 0; at < fractions.size(); at += 3)
  {
    const auto cancel = [&](double fraction, const std::string&)
    {
      if (fraction >= fractions[at]) throw Cancelled();
    };
    EXPECT_THROW(meshTissues(map, uniformScale(2), {}, cancel), Cancelled);
  }
}

TEST(SurfaceMesher, RoughnessGoesOnlyWhereTheSurfaceMaySmoothAndDrift)
{
  const TissueMap map = paintedMap({ 16, 16, 16 },
                                   [](int i, int j, int k) {
                                     return squareAt(i, j, k, { 8, 8, 8 }) < 36 && (i != 8 || j < 8);
                                   });
  TissueMesherOptions options;
  EXPECT_FALSE(meshTissues(map, uniformScale(4), options).smoothed.empty());
  options.maximumDistance = 1.5;
  EXPECT_TRUE(meshTissues(map, uniformScale(4), options).smoothed.empty());
  options = {};
  options.smoothing = 0;
  EXPECT_TRUE(meshTissues(map, uniformScale(4), options).smoothed.empty());
}

TEST(SurfaceMesher, TakesFewerSamplesWhereVoxelsAreFineAndTissuesThick)
{
  // A cube of 40 voxels, whose lowest layers are a tissue of their own: samples times triangles of length L.
  const auto samples = [](int layers, double length)
  {
    const TissueMap map = paintedMap({ 44, 44, 44 },
                                     [=](int i, int j, int k)
                                     {
                                       if (std::min({ i, j, k }) < 2 || std::max({ i, j, k }) >= 42) return 0;
                                       return k < 2 + layers ? 2 : 1;
                                     });
    const double triangle = 0.25 * std::sqrt(3.0) * length * length;
    return double(meshed(map, uniformScale(length)).background.samples.size()) * triangle;
  };
  const auto expectAbout = [](double number, double wanted) { EXPECT_NEAR(number, wanted, 0.05 * wanted); };
  constexpr double side = 1600;
  expectAbout(samples(0, 12), 16 * 6 * side);
  expectAbout(samples(0, 13), 10 * 6 * side);
  expectAbout(samples(20, 13), 10 * 7 * side);
  expectAbout(samples(4, 13), 16 * (2 + 4 * 0.1) * side + 10 * (1 + 4 * 0.9) * side); // thin on one side of its faces
}

} // namespace surgicalmesher
