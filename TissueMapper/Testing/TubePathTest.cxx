// SPDX-License-Identifier: Apache-2.0
#include "TubePath.h"

#include "Errors.h"
#include "FluxField.h"
#include "MinimalPath.h"
#include "TubePhantoms.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <numeric>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

double meanOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

ScalarImage drawn(const TubeScene& scene, double noise = 0, const Vec3& spacing = { 1, 1, 1 })
{
  ScalarImage image = drawTubes(gridAround(scene.tubes, 8, spacing), scene.tubes);
  std::mt19937 random(5);
  if (noise > 0) addNoise(image, noise, random);
  return image;
}

TubeScene helix(double radius = 1.5, double gapLength = 0)
{
  std::mt19937 random(11);
  return helixScene(randomPlacement(random), radius, gapLength);
}

/// The same image with other axes: voxel (i, j, k) of the new grid is voxel order(i, j, k) of the old one.
ScalarImage permuted(const ScalarImage& image)
{
  ScalarImage result;
  const Grid& old = image.grid;
  Grid& grid = result.grid;
  grid.size = { old.size[2], old.size[0], old.size[1] };
  grid.spacing = { old.spacing.z, old.spacing.x, old.spacing.y };
  grid.axes = { old.axes[2], old.axes[0], old.axes[1] };
  grid.origin = old.origin;
  result.values.resize(image.values.size());
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i) result.values[grid.index(i, j, k)] = image.values[old.index(j, k, i)];
  return result;
}

/// The same image in another unit of length.
ScalarImage scaled(ScalarImage image, double scale)
{
  image.grid.spacing = scale * image.grid.spacing;
  image.grid.origin = scale * image.grid.origin;
  return image;
}

std::vector<Vec3> scaled(std::vector<Vec3> points, double scale)
{
  for (Vec3& p : points) p = scale * p;
  return points;
}

TubePathOptions scaledOptions(double scale)
{
  TubePathOptions options;
  options.snapDistance *= scale;
  options.margin *= scale;
  return options;
}

} // namespace

TEST(FluxField, IsThatOfAWaveInClosedForm)
{
  // Along one axis of a periodic image a cosine of wave number k has M(x, R) = cos(kx) sin(kR) / kR.
  ScalarImage image;
  image.grid.size = { 64, 8, 8 };
  image.grid.spacing = { 0.8, 1, 1.5 };
  image.values.resize(image.grid.voxelCount());
  const double k = 2 * 3.14159265358979323846 / 8;
  for (std::size_t n = 0; n < image.values.size(); ++n) image.values[n] = float(std::cos(k * 0.8 * double(n % 64)));
  const FluxField field = computeFlux(image, { 1, 2, 2.5 });
  for (std::size_t r = 0; r < field.radii.size(); ++r)
  {
    const double radius = sphereRadius(field.radii[r]);
    const double blur = k * sphereBlur(radius);
    const double expected = (std::sin(k * radius) / (k * radius) - std::cos(k * radius)) * std::exp(-0.5 * blur * blur);
    // Voxel 30 is a crest, far from the ends, which aren't periodic.
    EXPECT_NEAR(field.flux[r][image.grid.index(30, 4, 4)], expected, 0.01) << field.radii[r];
  }
}

TEST(FluxField, VanishesWhereNothingVaries)
{
  ScalarImage image;
  image.grid.size = { 20, 11, 13 };
  image.values.assign(image.grid.voxelCount(), 1000);
  const FluxField field = computeFlux(image, { 0.5, 1, 2 });
  for (const std::vector<float>& flux : field.flux)
    for (const float value : flux) EXPECT_NEAR(value, 0, 1e-3);
}

TEST(MinimalPath, IsStraightInAUniformSpeed)
{
  Grid grid;
  grid.size = { 30, 40, 20 };
  grid.spacing = { 0.7, 1, 1.3 };
  const std::vector<float> speed(grid.voxelCount(), 1);
  const Vec3 a{ 3.2, 4.1, 5.3 };
  const Vec3 b{ 17.4, 31.7, 20.2 };
  const std::vector<Vec3> path = minimalPath(grid, speed, a, b);
  EXPECT_EQ(norm(path.front() - a), 0);
  EXPECT_EQ(norm(path.back() - b), 0);
  EXPECT_LT(distancesTo(path, { a, b })[1], 1.3); // a voxel: marching is of first order
  EXPECT_LT(polylineLength(path), 1.02 * norm(b - a));
}

TEST(MinimalPath, GoesRoundAWallAndSaysWhenThereIsNoWay)
{
  Grid grid;
  grid.size = { 31, 31, 9 };
  std::vector<float> speed(grid.voxelCount(), 1);
  for (int k = 0; k < 9; ++k)
    for (int j = 0; j < 31; ++j) speed[grid.index(15, j, k)] = j < 25 ? 0.f : 1.f;
  const std::vector<Vec3> path = minimalPath(grid, speed, { 5, 10, 4 }, { 25, 10, 4 });
  for (const Vec3& p : path) EXPECT_TRUE(std::abs(p.x - 15) > 0.6 || p.y > 24) << p.x << " " << p.y;
  for (int k = 0; k < 9; ++k)
    for (int j = 0; j < 31; ++j) speed[grid.index(15, j, k)] = 0;
  EXPECT_THROW(minimalPath(grid, speed, { 5, 10, 4 }, { 25, 10, 4 }), InputError);
}

TEST(PathRefinement, SmoothsNoLineAndKeepsTheWeightsOrder)
{
  std::vector<Vec3> line;
  for (int n = 0; n < 20; ++n) line.push_back({ 0.5 * n, 1.0 * n, -0.25 * n });
  const std::vector<Vec3> same = smoothed(line, std::vector<double>(20, 1), std::vector<double>(20, 30), 0.5);
  for (int n = 0; n < 20; ++n) EXPECT_NEAR(norm(same[n] - line[n]), 0, 1e-9);
  std::vector<Vec3> bump = line;
  bump[10].z += 1;
  std::vector<double> weights(20, 1);
  const double before = smoothed(bump, weights, std::vector<double>(20, 3), 0.5)[10].z - line[10].z;
  weights[10] = 0.05;
  const double after = smoothed(bump, weights, std::vector<double>(20, 3), 0.5)[10].z - line[10].z;
  EXPECT_GT(before, 2 * after);
  EXPECT_GT(after, 0);
}

TEST(TubePath, KeepsToTheAxisAndKnowsTheRadius)
{
  for (const double radius : { 1.0, 2.0, 3.0 })
  {
    const TubeScene scene = helix(radius, 10);
    const TubePath tube = traceTube(drawn(scene, 0.2), scene.places, {}, {});
    const PathError error = pathError(tube.points, scene.truth);
    EXPECT_LT(error.mean, 0.3) << radius;
    EXPECT_LT(error.largest, 1) << radius;
    EXPECT_NEAR(meanOf(tube.radii), radius, 0.2);
    EXPECT_EQ(tube.radii.size(), tube.points.size());
    EXPECT_EQ(tube.flux.size(), tube.points.size());
    EXPECT_TRUE(tube.isBright);
  }
}

TEST(TubePath, FindsADarkTubeLikeABrightOne)
{
  const TubeScene scene = helix();
  ScalarImage image = drawn(scene, 0.1);
  const TubePath bright = traceTube(image, scene.places, {}, {});
  for (float& value : image.values) value = 1 - value;
  const TubePath dark = traceTube(image, scene.places, {}, {});
  EXPECT_FALSE(dark.isBright);
  ASSERT_EQ(dark.points.size(), bright.points.size());
  for (std::size_t n = 0; n < dark.points.size(); ++n) EXPECT_LT(norm(dark.points[n] - bright.points[n]), 0.02);
}

TEST(TubePath, TakesTheSameWayAtACrossing)
{
  std::mt19937 random(3);
  const TubeScene scene = crossingScene(randomPlacement(random), 1.5);
  const PathError error = pathError(traceTube(drawn(scene, 0.2), scene.places, {}, {}).points, scene.truth);
  EXPECT_LT(error.largest, 1);
}

TEST(TubePath, IsNotDrawnToAThickerThingBesideAFaintStretch)
{
  TubeScene scene = helix(1, 10);
  const std::size_t middle = scene.truth.size() / 2;
  const Vec3 across = cross(scene.truth[middle + 5] - scene.truth[middle - 5], { -0.3, 0.5, -0.8 });
  PhantomTube ball;
  ball.radius = 3;
  ball.axis = { scene.truth[middle] + (5.5 / norm(across)) * across };
  ball.contrast = { 1 };
  scene.tubes.push_back(ball);
  const TubePath tube = traceTube(drawn(scene, 0.2), scene.places, {}, {});
  const PathError error = pathError(tube.points, scene.truth);
  EXPECT_LT(error.mean, 0.3);
  EXPECT_LT(error.largest, 1);
  EXPECT_NEAR(meanOf(tube.radii), 1, 0.2);
}

TEST(TubePath, PointsOffTheAxisAreDrawnToIt)
{
  TubeScene scene = helix(1);
  const Vec3 along = scene.truth[10] - scene.truth[0];
  const Vec3 off = cross(along, { 0.3, -0.5, 0.8 });
  scene.places[0] += (0.7 / norm(off)) * off;
  const ScalarImage image = drawn(scene, 0.2);
  EXPECT_LT(pathError(traceTube(image, scene.places, {}, {}).points, scene.truth).largest, 1);
}

TEST(TubePath, FollowsACoilThroughPointsHalfATurnApart)
{
  std::mt19937 random(7);
  const TubeScene scene = coilScene(randomPlacement(random), 1, 4);
  const PathError error = pathError(traceTube(drawn(scene, 0.2), scene.places, {}, {}).points, scene.truth);
  EXPECT_LT(error.mean, 0.3);
  EXPECT_LT(error.largest, 1);
}

TEST(TubePath, KeepsOutOfABlockedTube)
{
  std::mt19937 random(17);
  const TubeScene scene = kissingScene(randomPlacement(random), 2, 10);
  const ScalarImage image = drawn(scene, 0.2);
  const std::vector<Vec3>& other = scene.tubes[1].axis;
  const TubePath neighbour = traceTube(image, { other[40], other[other.size() - 41] }, {}, {});
  const PathError error = pathError(traceTube(image, scene.places, { neighbour }, {}).points, scene.truth);
  EXPECT_LT(error.mean, 0.3);
  EXPECT_LT(error.largest, 1);
}

TEST(TubePath, IsTheSameInPermutedAndShiftedFrames)
{
  const TubeScene scene = helix();
  const ScalarImage image = drawn(scene);
  const TubePath tube = traceTube(image, scene.places, {}, {});
  EXPECT_LT(pathError(traceTube(permuted(image), scene.places, {}, {}).points, tube.points).largest, 0.1);
  Grid shifted = image.grid;
  shifted.origin += Vec3{ 0.3, -0.4, 0.25 };
  const TubePath other = traceTube(drawTubes(shifted, scene.tubes), scene.places, {}, {});
  EXPECT_LT(pathError(other.points, tube.points).mean, 0.03);
  EXPECT_LT(pathError(other.points, tube.points).largest, 0.1);
}

TEST(TubePath, IsTheSameInObliqueAndAnisotropicFrames)
{
  const TubeScene scene = helix();
  const TubePath tube = traceTube(drawn(scene), scene.places, {}, {});
  const TubePath flat = traceTube(drawn(scene, 0, { 0.8, 0.8, 1.4 }), scene.places, {}, {});
  EXPECT_LT(pathError(flat.points, tube.points).largest, 0.1);

  Grid oblique = drawn(scene).grid;
  std::mt19937 random(23);
  oblique.axes = randomPlacement(random).axes;
  oblique.size = { 70, 70, 70 };
  const Vec3 middle = scene.truth[scene.truth.size() / 2];
  oblique.origin = middle - 34.5 * (oblique.axes[0] + oblique.axes[1] + oblique.axes[2]);
  const TubePath turned = traceTube(drawTubes(oblique, scene.tubes), scene.places, {}, {});
  EXPECT_LT(pathError(turned.points, tube.points).largest, 0.1);
}

TEST(TubePath, ScalesWithTheImage)
{
  // A tight coil: where the path bends, smoothing is adapted to the radius of the bend in voxels.
  std::mt19937 random(7);
  const TubeScene scene = coilScene(randomPlacement(random), 1, 4);
  const ScalarImage image = drawn(scene, 0.2);
  const TubePath tube = traceTube(image, scene.places, {}, {});
  for (const double scale : { 0.5, 2.0 })
  {
    const TubePath other = traceTube(scaled(image, scale), scaled(scene.places, scale), {}, scaledOptions(scale));
    ASSERT_EQ(other.points.size(), tube.points.size()) << scale;
    for (std::size_t n = 0; n < tube.points.size(); ++n)
    {
      EXPECT_LT(norm(other.points[n] / scale - tube.points[n]), 1e-3) << scale;
      EXPECT_NEAR(other.radii[n] / scale, tube.radii[n], 1e-3) << scale;
    }
  }
}

TEST(TubePath, IsTheSameOnOneThreadAndMany)
{
  const TubeScene scene = helix();
  const ScalarImage image = drawn(scene, 0.2);
  vtkSMPTools::Initialize(1);
  const TubePath one = traceTube(image, scene.places, {}, {});
  vtkSMPTools::Initialize(3);
  const TubePath three = traceTube(image, scene.places, {}, {});
  vtkSMPTools::Initialize();
  ASSERT_EQ(one.points.size(), three.points.size());
  for (std::size_t n = 0; n < one.points.size(); ++n) EXPECT_TRUE(one.points[n] == three.points[n]);
  EXPECT_EQ(one.radii, three.radii);
  EXPECT_EQ(one.flux, three.flux);
}

TEST(TubePath, HasNoRadiusBeyondThoseAskedFor)
{
  const TubeScene scene = helix(1.5);
  const ScalarImage image = drawn(scene);
  for (const auto& [least, largest] : { std::pair(1.7, 2.0), std::pair(0.9, 1.3) })
  {
    TubePathOptions options;
    options.minimumRadius = least;
    options.maximumRadius = largest;
    for (const double radius : traceTube(image, scene.places, {}, options).radii)
    {
      EXPECT_GE(radius, least);
      EXPECT_LE(radius, largest);
    }
  }
}

TEST(TubePath, RefusesWhatItCanNotTrace)
{
  const TubeScene scene = helix();
  const ScalarImage image = drawn(scene);
  EXPECT_THROW(traceTube(image, { scene.places[0] }, {}, {}), InputError);
  EXPECT_THROW(traceTube(image, { scene.places[0], { 500, 0, 0 } }, {}, {}), InputError);
  EXPECT_THROW(traceTube(image, { scene.places[0], scene.places[0] }, {}, {}), InputError);
  ScalarImage even = image;
  std::fill(even.values.begin(), even.values.end(), 7.f);
  EXPECT_THROW(traceTube(even, scene.places, {}, {}), InputError);
  TubePathOptions options;
  options.minimumRadius = 9;
  EXPECT_THROW(traceTube(image, scene.places, {}, options), UsageError);
}

TEST(TubePath, CanBeCancelled)
{
  const TubeScene scene = helix();
  const ScalarImage image = drawn(scene);
  struct Cancelled
  {
  };
  const Progress cancel = [](double fraction, const std::string&)
  {
    if (fraction > 0.3) throw Cancelled();
  };
  EXPECT_THROW(traceTube(image, scene.places, {}, {}, cancel), Cancelled);
}
