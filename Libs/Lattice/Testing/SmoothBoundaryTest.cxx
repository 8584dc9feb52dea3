// SPDX-License-Identifier: Apache-2.0
#include "SmoothBoundary.h"

#include "MeshChecks.h"
#include "RandomMaps.h"
#include "SampleTransfer.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <cmath>

namespace surgicalmesher
{
namespace
{

using namespace test;

constexpr double usual = 0.6;

KuhnLattice latticeOf(const TissueMap& map) { return kuhnLattice(map, uniformScale(4), {}); }

KuhnLattice smoothLattice(const TissueMap& map, double voxels = usual)
{
  KuhnLattice lattice = latticeOf(map);
  moveToSmoothBoundary(lattice, map, { .voxels = voxels });
  return lattice;
}

TissueMap ball(double radius, const Vec3& spacing = { 1, 1, 1 })
{
  const int size = 2 * int(std::ceil(radius)) + 5;
  const double middle = 0.5 * (size - 1);
  return paintedMap(
    { size, size, size },
    [&](int i, int j, int k) {
      return squaredNorm(Vec3{ i - middle, j - middle, k - middle }) < radius * radius;
    },
    spacing);
}

Vec3 unitNormal(const BackgroundMesh::Sample& sample)
{
  const Vec3 n{ sample.normal[0], sample.normal[1], sample.normal[2] };
  return n / norm(n);
}

double degreesBetween(const Vec3& a, const Vec3& b) { return std::acos(std::min(1.0, dot(a, b))) * 180 / M_PI; }

TEST(SmoothBoundary, liesOnBallsWithTheirNormals)
{
  for (double radius : { 6.0, 10.0, 14.0 })
  {
    const TissueMap map = ball(radius);
    const double middle = 0.5 * (map.grid.size[0] - 1);
    double squares = 0, angles = 0;
    const KuhnLattice lattice = smoothLattice(map);
    for (const auto& sample : lattice.background.samples)
    {
      const Vec3 out = sample.position - Vec3{ middle, middle, middle };
      EXPECT_NEAR(norm(out), radius, 0.5);
      squares += (norm(out) - radius) * (norm(out) - radius);
      angles += degreesBetween(out / norm(out), unitNormal(sample));
    }
    const double n = double(lattice.background.samples.size());
    EXPECT_LT(std::sqrt(squares / n), 0.15) << radius; // 0.29 at the centres of the voxels' faces
    EXPECT_LT(angles / n, 5) << radius;                // 35 there
  }
}

// Around its poles a ball of voxels is flat for 6 of them, and half a voxel below the sphere.
TEST(SmoothBoundary, liesOnTheCapsOfLargeBalls)
{
  const TissueMap map = ball(20);
  const double middle = 0.5 * (map.grid.size[0] - 1);
  double farthest = 0;
  for (const auto& sample : smoothLattice(map).background.samples)
    farthest = std::max(farthest, std::abs(norm(sample.position - Vec3{ middle, middle, middle }) - 20));
  EXPECT_LT(farthest, 0.35); // 0.5 by neighbours within two voxels
}

/// The same with voxels in blocks of eight, as a map of half the resolution has them.
TissueMap ballOfBlocks(double radius)
{
  const int size = 2 * int(std::ceil(radius)) + 5;
  const double middle = 0.5 * (size - 1);
  const auto inBlock = [&](int i) { return 2 * (i / 2) + 0.5 - middle; };
  return paintedMap({ size, size, size },
                    [&](int i, int j, int k) {
                      return squaredNorm(Vec3{ inBlock(i), inBlock(j), inBlock(k) }) < radius * radius;
                    });
}

/// Root mean square of the points' distances from the sphere in the middle of its map.
double distanceFromBall(const std::vector<Vec3>& points, double radius)
{
  const double middle = std::ceil(radius) + 2;
  double squares = 0;
  for (const Vec3& p : points) squares += std::pow(norm(p - Vec3{ middle, middle, middle }) - radius, 2);
  return std::sqrt(squares / double(points.size()));
}

TEST(SmoothBoundary, takesStepsOfBlocksAwayWhereLIsLong)
{
  constexpr double radius = 20;
  const TissueMap map = ballOfBlocks(radius);
  const auto distance = [&](double length, bool isWider)
  {
    KuhnLattice lattice = kuhnLattice(map, uniformScale(length), {});
    moveToSmoothBoundary(lattice, map, { .voxels = usual, .isWiderWithL = isWider });
    std::vector<Vec3> places;
    for (const auto& sample : lattice.background.samples) places.push_back(sample.position);
    return distanceFromBall(places, radius);
  };
  EXPECT_GT(distance(8, true), 0.3);
  EXPECT_LT(distance(16, true), 0.2);
  EXPECT_NEAR(distance(16, false), distance(8, true), 1e-6);
}

TEST(SmoothBoundary, takesFacesBetweenBlocksToTheBoundary)
{
  constexpr double radius = 14, length = 8;
  const TissueMap map = ball(radius);
  KuhnLattice lattice =
    latticeWithSamplesOf(map, ballOfBlocks(radius), uniformScale(length), [&](const Vec3&) { return length; },
                         { [](const VoxelFace&, double) { return 16; } });
  const auto distance = [&]
  {
    std::vector<Vec3> places;
    for (const auto& [t, face] : lattice.interfaceFaces)
      for (int k = 1; k <= 3; ++k)
        places.push_back(lattice.background.mesh.points[lattice.background.mesh.tetrahedra[t][(face + k) & 3]]);
    return distanceFromBall(places, radius);
  };
  EXPECT_GT(distance(), 0.5);
  moveToSmoothBoundary(lattice, map, { .voxels = usual });
  EXPECT_LT(distance(), 0.3);
  EXPECT_NO_THROW(requireSound(lattice.background.mesh, "lattice"));
}

TEST(SmoothBoundary, keepsFlatWalls)
{
  const TissueMap map = paintedMap({ 24, 24, 24 },
                                   [](int i, int j, int k) {
                                     return std::min({ i, j, k }) >= 4 && std::max({ i, j, k }) < 20;
                                   });
  for (const auto& sample : smoothLattice(map).background.samples)
  {
    Vec3 depth; // below the nearer of the two walls across each axis
    for (int a = 0; a < 3; ++a) depth[a] = std::min(sample.position[a] - 3.5, 19.5 - sample.position[a]);
    int nearest = 0;
    for (int a = 1; a < 3; ++a)
      if (depth[a] < depth[nearest]) nearest = a;
    EXPECT_LT(std::abs(depth[nearest]), 0.45);
    const bool isFlat = depth[(nearest + 1) % 3] > 2 && depth[(nearest + 2) % 3] > 2;
    if (!isFlat) continue;
    EXPECT_LT(std::abs(depth[nearest]), 0.1);
    EXPECT_GT(std::abs(unitNormal(sample)[nearest]), 0.99);
  }
}

TEST(SmoothBoundary, keepsSheetsOfOneVoxel)
{
  const TissueMap map = paintedMap({ 20, 20, 11 }, [](int, int, int k) { return k < 5 ? 1 : k == 5 ? 3 : 2; });
  double below = 0, above = 0, samples = 0;
  for (const auto& sample : smoothLattice(map).background.samples)
  {
    const Vec3& p = sample.position;
    const bool isInside = std::min(p.x, p.y) > 4 && std::max(p.x, p.y) < 15;
    if (!isInside || p.z < 4 || p.z > 6) continue;
    EXPECT_GT(std::abs(p.z - 5), 0.3);
    (p.z < 5 ? below : above) += p.z;
    samples += 0.5;
  }
  ASSERT_GT(samples, 0);
  EXPECT_NEAR((above - below) / samples, 1, 0.15);
}

/// What the ways of the samples across the voxels' faces add to each tissue, over its volume.
std::map<Label, double> gains(const TissueMap& map, const KuhnLattice& before, const KuhnLattice& after)
{
  std::map<Label, double> result;
  const auto& old = before.background.samples;
  for (std::size_t i = 0; i < old.size(); ++i)
  {
    std::array<int, 3> below, above;
    int axis = 0;
    for (int a = 0; a < 3; ++a)
    {
      below[a] = int(std::floor(old[i].position[a] + 0.01));
      above[a] = int(std::ceil(old[i].position[a] - 0.01));
      if (below[a] != above[a]) axis = a;
    }
    const double way = (after.background.samples[i].position - old[i].position)[axis];
    result[labelAt(map, below)] += way;
    result[labelAt(map, above)] -= way;
  }
  const auto voxels = countVoxels(map);
  for (auto& [label, gain] : result) gain /= double(voxels.at(label));
  return result;
}

TEST(SmoothBoundary, keepsTheVolumesOfTissuesThatMeet)
{
  const TissueMap map = paintedMap({ 26, 26, 26 },
                                   [](int i, int j, int k)
                                   {
                                     const Vec3 p{ i - 12.5, j - 12.5, k - 12.5 };
                                     if (squaredNorm(p) > 100) return 0;
                                     return p.x + 0.4 * p.y > 0 ? 1 : p.y + 0.3 * p.z > 0 ? 2 : 3;
                                   });
  const KuhnLattice before = latticeOf(map), after = smoothLattice(map);
  for (const auto& [label, gain] : gains(map, before, after))
  {
    if (label == 0) continue; // the rest of space
    EXPECT_LT(std::abs(gain), 0.005) << label;
  }
  for (std::size_t i = 0; i < before.background.samples.size(); ++i)
    EXPECT_LT(norm(after.background.samples[i].position - before.background.samples[i].position), 1.2);
}

TEST(SmoothBoundary, leavesASoundLatticeOnAnyMap)
{
  std::mt19937 random(7);
  for (int n = 0; n < 5; ++n)
  {
    const TissueMap map = randomWellComposedMap(random, { 14, 12, 10 }, 4);
    const KuhnLattice before = latticeOf(map), after = smoothLattice(map);
    EXPECT_NO_THROW(requireSound(after.background.mesh, "lattice"));
    EXPECT_EQ(after.background.mesh.labels, before.background.mesh.labels);
    for (const auto& sample : after.background.samples)
    {
      EXPECT_TRUE(std::isfinite(squaredNorm(sample.position)));
      EXPECT_NEAR(norm(unitNormal(sample)), 1, 1e-6);
    }
  }
}

TEST(SmoothBoundary, followsTheVoxelsShape)
{
  const TissueMap cubic = ball(8), flat = ball(8, { 1, 1, 2.5 });
  const KuhnLattice a = smoothLattice(cubic), b = smoothLattice(flat);
  ASSERT_EQ(a.background.samples.size(), b.background.samples.size());
  const auto sumOfHeights = [](const KuhnLattice& lattice, double spacing)
  {
    double sum = 0;
    for (const auto& sample : lattice.background.samples) sum += std::abs(sample.position.z / spacing - 10);
    return sum;
  };
  EXPECT_NEAR(sumOfHeights(a, 1), sumOfHeights(b, 2.5), 1e-6 * sumOfHeights(a, 1));
}

TEST(SmoothBoundary, doesNotDependOnThreads)
{
  std::mt19937 random(3);
  const TissueMap map = randomWellComposedMap(random, { 16, 16, 16 }, 3);
  vtkSMPTools::Initialize(1);
  const KuhnLattice one = smoothLattice(map);
  vtkSMPTools::Initialize(4);
  const KuhnLattice four = smoothLattice(map);
  vtkSMPTools::Initialize(0);
  ASSERT_EQ(one.background.samples.size(), four.background.samples.size());
  for (std::size_t i = 0; i < one.background.samples.size(); ++i)
  {
    EXPECT_EQ(one.background.samples[i].position, four.background.samples[i].position);
    EXPECT_EQ(one.background.samples[i].normal, four.background.samples[i].normal);
  }
  EXPECT_EQ(one.background.mesh.points, four.background.mesh.points);
}

} // namespace
} // namespace surgicalmesher
