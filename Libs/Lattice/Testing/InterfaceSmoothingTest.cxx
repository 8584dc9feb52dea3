// SPDX-License-Identifier: Apache-2.0
#include "InterfaceSmoothing.h"
#include "FaceAdjacency.h"
#include "GuardedOperations.h"
#include "MeshChecks.h"
#include "RandomMaps.h"
#include "TetQuality.h"
#include "Triangle.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <cmath>

namespace surgicalmesher
{
namespace
{

using namespace test;

KuhnLattice latticeOf(const TissueMap& map, double edgeLength = 4)
{
  return kuhnLattice(map, uniformScale(edgeLength), {});
}

KuhnLattice smoothed(const TissueMap& map, const SmoothingOptions& options = {}, double edgeLength = 4)
{
  KuhnLattice lattice = latticeOf(map, edgeLength);
  smoothInterface(lattice, map.grid.spacing, options);
  return lattice;
}

TissueMap ball(double radius, const Vec3& spacing = { 1, 1, 1 })
{
  std::array<int, 3> size;
  for (int a = 0; a < 3; ++a) size[a] = 2 * int(std::ceil(radius / spacing[a])) + 3;
  return paintedMap(
    size,
    [&](int i, int j, int k)
    {
      const Vec3 p{ (i - size[0] / 2) * spacing.x, (j - size[1] / 2) * spacing.y, (k - size[2] / 2) * spacing.z };
      return norm(p) <= radius;
    },
    spacing);
}

Vec3 middleOf(const TissueMap& map)
{
  Vec3 middle;
  for (int a = 0; a < 3; ++a) middle[a] = (map.grid.size[a] / 2) * map.grid.spacing[a];
  return middle;
}

/// Root mean square distance of the surface's vertices, and of the samples, to the sphere.
double rmsOfVertices(const KuhnLattice& lattice, const Vec3& centre, double radius)
{
  const SurfaceComplex surface = interfaceOf(lattice.background.mesh);
  double sum = 0;
  for (const Vec3& p : surface.points) sum += (norm(p - centre) - radius) * (norm(p - centre) - radius);
  return std::sqrt(sum / double(surface.points.size()));
}

double rmsOfSamples(const KuhnLattice& lattice, const Vec3& centre, double radius)
{
  double sum = 0;
  for (const auto& e : lattice.background.samples)
    sum += (norm(e.position - centre) - radius) * (norm(e.position - centre) - radius);
  return std::sqrt(sum / double(lattice.background.samples.size()));
}

double worstOf(const TetMesh& mesh)
{
  double worst = 1;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    worst = std::min(worst, worstSine2(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]));
  return worst;
}

} // namespace

TEST(ReferenceSurface, ComesCloserToTheSphereThatWasDigitised)
{
  for (double radius : { 8.0, 9.3, 12.5 })
  {
    const TissueMap map = ball(radius);
    const Vec3 centre = middleOf(map);
    const KuhnLattice before = latticeOf(map), after = smoothed(map);
    EXPECT_LT(rmsOfVertices(after, centre, radius), 0.6 * rmsOfVertices(before, centre, radius)) << radius;
    EXPECT_LT(rmsOfSamples(after, centre, radius), 0.85 * rmsOfSamples(before, centre, radius)) << radius;
    const double volume = checkSurface(interfaceOf(after.background.mesh)).at(1).volume;
    const double voxels = checkSurface(interfaceOf(before.background.mesh)).at(1).volume;
    EXPECT_NEAR(volume, voxels, 0.01 * voxels) << radius;
  }
}

TEST(ReferenceSurface, ComesCloserToASphereInSlices)
{
  const Vec3 spacing{ 0.98, 0.98, 2.5 };
  const TissueMap map = ball(14, spacing);
  const KuhnLattice before = latticeOf(map), after = smoothed(map);
  EXPECT_LT(rmsOfVertices(after, middleOf(map), 14), rmsOfVertices(before, middleOf(map), 14));
  const double voxels = checkSurface(interfaceOf(before.background.mesh)).at(1).volume;
  EXPECT_NEAR(checkSurface(interfaceOf(after.background.mesh)).at(1).volume, voxels, 0.01 * voxels);
}

TEST(ReferenceSurface, KeepsTheMeshSoundAndVerticesWithinTheirBox)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    TissueMap map = randomWellComposedMap(random, { 8, 7, 9 }, 1 + int(seed % 4), 90);
    if (seed % 2) map.grid.spacing = { 0.98, 0.98, 2.5 };
    SmoothingOptions options;
    options.box = seed % 3 ? 0.5 : 0.3;
    const KuhnLattice before = latticeOf(map), after = smoothed(map, options);
    const TetMesh &mesh = after.background.mesh, &start = before.background.mesh;
    EXPECT_EQ(mesh.tetrahedra, start.tetrahedra);
    EXPECT_EQ(mesh.labels, start.labels);
    requireSound(mesh, "smoothing");
    EXPECT_GE(worstOf(mesh), std::min(worstOf(start), sine2OfDegrees(options.minimumAngle)) * (1 - 1e-12));
    std::vector<bool> onInterface(mesh.points.size(), false);
    for (const auto& [t, f] : before.interfaceFaces)
    {
      for (int k = 1; k < 4; ++k) onInterface[mesh.tetrahedra[t][(f + k) & 3]] = true;
    }
    int moved = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
    {
      const Vec3 way = mesh.points[v] - start.points[v];
      for (int a = 0; a < 3; ++a) EXPECT_LE(std::abs(way[a]), options.box * map.grid.spacing[a] + 1e-9);
      EXPECT_TRUE(onInterface[v] || norm(way) == 0) << "only the interface moves";
      moved += norm(way) > 1e-6;
    }
    EXPECT_GT(moved, 0);
  }
}

TEST(ReferenceSurface, LeavesAPlaneWhereItIs)
{
  const auto slab = paintedMap({ 16, 16, 16 }, [](int, int, int k) { return k < 8 ? 1 : 2; });
  const KuhnLattice before = latticeOf(slab, 1), after = smoothed(slab, {}, 1);
  ASSERT_EQ(before.background.samples.size(), after.background.samples.size());
  int inside = 0;
  for (std::size_t v = 0; v < before.background.mesh.points.size(); ++v)
  {
    const Vec3 home = before.background.mesh.points[v];
    // Away from the sides, where the plane ends in a curve between three labels.
    if (home.z != 7.5 || std::max(std::abs(home.x - 7.5), std::abs(home.y - 7.5)) > 3) continue;
    ++inside;
    EXPECT_NEAR(after.background.mesh.points[v].z, 7.5, 1e-9);
  }
  EXPECT_GT(inside, 4);
  for (const auto& e : after.background.samples)
  {
    const double aside = std::max(std::abs(e.position.x - 7.5), std::abs(e.position.y - 7.5));
    EXPECT_FALSE(aside < 3 && std::abs(e.position.z - 7.5) < 2 && std::abs(e.position.z - 7.5) > 1e-9);
  }
}

TEST(ReferenceSurface, KeepsAPointWhereCurvesMeet)
{
  // Four labels and the outside: the curves between three of them meet in the middle.
  const auto map = paintedMap({ 8, 8, 8 }, [](int i, int j, int k) { return k < 4 ? 1 : i < 4 ? 2 : j < 4 ? 3 : 4; });
  const KuhnLattice before = latticeOf(map), after = smoothed(map);
  int found = 0;
  for (std::size_t v = 0; v < before.background.mesh.points.size(); ++v)
  {
    if (norm(before.background.mesh.points[v] - Vec3{ 3.5, 3.5, 3.5 }) > 1e-9) continue;
    ++found;
    EXPECT_TRUE(after.background.mesh.points[v] == before.background.mesh.points[v]);
  }
  EXPECT_EQ(found, 1);
}

TEST(ReferenceSurface, SamplesGoAlongWithTheirFace)
{
  const TissueMap map = ball(7);
  KuhnLattice lattice = latticeOf(map);
  SmoothingOptions options;
  options.minimumAngle = 1; // no move is cut short
  options.samples = 1;
  smoothInterface(lattice, map.grid.spacing, options);
  const auto& mesh = lattice.background.mesh;
  for (const auto& e : lattice.background.samples)
  {
    const auto& t = mesh.tetrahedra[e.tetrahedron];
    const auto corner = [&](int k) { return mesh.points[t[(e.face + k) & 3]]; };
    EXPECT_LT(squaredDistanceToTriangle(e.position, corner(1), corner(2), corner(3)), 0.01);
  }
  KuhnLattice staying = latticeOf(map);
  options.samples = 0;
  smoothInterface(staying, map.grid.spacing, options);
  const KuhnLattice before = latticeOf(map);
  for (std::size_t e = 0; e < before.background.samples.size(); ++e)
    EXPECT_TRUE(staying.background.samples[e].position == before.background.samples[e].position);
}

TEST(ReferenceSurface, BytesDoNotDependOnThreads)
{
  std::mt19937 random(5);
  const TissueMap map = randomWellComposedMap(random, { 14, 12, 13 }, 4, 200);
  vtkSMPTools::Initialize(1);
  const KuhnLattice alone = smoothed(map);
  vtkSMPTools::Initialize(2);
  EXPECT_EQ(alone.background.mesh.points, smoothed(map).background.mesh.points);
  vtkSMPTools::Initialize(0);
}

} // namespace surgicalmesher
