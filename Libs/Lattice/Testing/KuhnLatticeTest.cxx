// SPDX-License-Identifier: Apache-2.0
#include "KuhnLattice.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "RandomMaps.h"
#include "ScaleMaps.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <cmath>
#include <set>

namespace surgicalmesher
{
namespace
{

using namespace test;

using Centre = std::array<double, 3>;

/// Centres of the voxel faces between two labels, the faces towards the outside included.
std::multiset<Centre> faceCentres(const TissueMap& map)
{
  std::multiset<Centre> centres;
  const Grid& grid = map.grid;
  const auto at = [&](int i, int j, int k) { return labelAt(map, { i, j, k }); };
  for (int k = -1; k < grid.size[2]; ++k)
  {
    for (int j = -1; j < grid.size[1]; ++j)
    {
      for (int i = -1; i < grid.size[0]; ++i)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          if (at(i, j, k) == at(i + (axis == 0), j + (axis == 1), k + (axis == 2))) continue;
          Centre c{ double(i), double(j), double(k) };
          c[axis] += 0.5;
          for (int a = 0; a < 3; ++a) c[a] = std::round(2 * c[a]) / 2;
          centres.insert(c);
        }
      }
    }
  }
  return centres;
}

/// In voxels, to a millionth.
std::multiset<Centre> sampleCentres(const KuhnLattice& lattice, const Vec3& spacing)
{
  std::multiset<Centre> centres;
  for (const auto& e : lattice.background.samples)
  {
    Centre c;
    for (int a = 0; a < 3; ++a) c[a] = std::round(2e6 * e.position[a] / spacing[a]) / 2e6;
    centres.insert(c);
  }
  return centres;
}

double worstAngle(const TetMesh& mesh)
{
  double worst = 90;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
  {
    for (double angle : dihedralAngles(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]))
      worst = std::min({ worst, angle, 180 - angle });
  }
  return worst;
}

/// The hull is a box: every face without a neighbour lies in one of six planes, and the volume is the box's.
void expectFillsABox(const TetMesh& mesh)
{
  Vec3 low = mesh.points[0], high = low;
  for (const Vec3& p : mesh.points)
  {
    for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], p[a]), high[a] = std::max(high[a], p[a]);
  }
  double volume = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    volume += orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) / 6;
  const double box = (high.x - low.x) * (high.y - low.y) * (high.z - low.z);
  EXPECT_NEAR(volume, box, 1e-9 * box);
  const auto neighbours = faceAdjacency(mesh);
  EXPECT_TRUE(neighbours.overused.empty());
  int elsewhere = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (int f = 0; f < 4; ++f)
    {
      if (neighbours.across[t][f] >= 0) continue;
      bool onSide = false;
      for (int a = 0; a < 3; ++a)
      {
        for (double side : { low[a], high[a] })
        {
          bool all = true;
          for (int k : kFaceCorners[f]) all = all && mesh.points[mesh.tetrahedra[t][k]][a] == side;
          onSide = onSide || all;
        }
      }
      elsewhere += !onSide;
    }
  }
  EXPECT_EQ(elsewhere, 0) << "faces inside the box belong to two tetrahedra";
}

void expectInterfaceFaces(const KuhnLattice& lattice)
{
  const TetMesh& mesh = lattice.background.mesh;
  const auto neighbours = faceAdjacency(mesh);
  std::set<std::pair<std::int32_t, std::int32_t>> expected;
  for (std::int32_t t = 0; t < std::int32_t(mesh.tetrahedra.size()); ++t)
  {
    for (std::int32_t f = 0; f < 4; ++f)
    {
      const std::int32_t n = neighbours.across[t][f];
      if (n >= 0 && mesh.labels[n] < mesh.labels[t]) expected.insert({ t, f });
    }
  }
  const std::set<std::pair<std::int32_t, std::int32_t>> found(lattice.interfaceFaces.begin(),
                                                              lattice.interfaceFaces.end());
  EXPECT_EQ(found, expected);
  EXPECT_EQ(found.size(), lattice.interfaceFaces.size()) << "each once";
  for (const auto& e : lattice.background.samples)
  {
    EXPECT_TRUE(found.count({ e.tetrahedron, e.face }));
    EXPECT_EQ(e.tolerance, 0);
  }
}

/// What must hold for every well-composed map and every scale.
void expectFaithful(const TissueMap& map, const ScaleField& scale, double angle, const LatticeOptions& options = {})
{
  ASSERT_TRUE(wellComposed(map));
  const KuhnLattice lattice = kuhnLattice(map, scale, options);
  const TetMesh& mesh = lattice.background.mesh;
  ASSERT_TRUE(checkMesh(mesh).none());
  EXPECT_GE(worstAngle(mesh), angle - 1e-6);
  expectFillsABox(mesh);
  requireSound(mesh, "lattice");
  EXPECT_EQ(meshTopology(mesh), tissueTopology(map));
  std::map<Label, double> expected;
  const double voxel = map.grid.spacing.x * map.grid.spacing.y * map.grid.spacing.z;
  for (Label label : map.labels)
  {
    if (label != 0) expected[label] += voxel;
  }
  const auto volumes = tissueVolumes(mesh);
  ASSERT_EQ(volumes.size(), expected.size());
  for (const auto& [label, volume] : expected)
    EXPECT_NEAR(volumes.at(label), volume, 1e-9 * volume) << "label " << label;
  EXPECT_EQ(sampleCentres(lattice, map.grid.spacing), faceCentres(map));
  expectInterfaceFaces(lattice);
  ASSERT_EQ(lattice.background.lengths.size(), mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    EXPECT_FLOAT_EQ(lattice.background.lengths[v], float(scale(map.grid.gridToWorld(mesh.points[v]))));
}

TissueMap randomMap(unsigned seed, const std::array<int, 3>& size, int labels, const Vec3& spacing = { 1, 1, 1 })
{
  std::mt19937 random(seed);
  TissueMap map = randomWellComposedMap(random, size, labels, 80);
  map.grid.spacing = spacing;
  map.grid.origin = { -10, 20, 35 };
  return map;
}

} // namespace

TEST(KuhnLattice, IsFaithfulToRandomMaps)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    expectFaithful(randomMap(seed, { 7, 6, 8 }, 1 + int(seed % 4)), uniformScale(3), 45);
  }
}

TEST(KuhnLattice, IsFaithfulWhereTheScaleIsGraded)
{
  const TissueMap map = randomMap(7, { 20, 16, 18 }, 3);
  expectFaithful(map, radialScale(map.grid, map.grid.gridToWorld({ 9, 8, 9 }), 1, 8, 3, 6), 45);
}

TEST(KuhnLattice, IsFaithfulBelowTheVoxel)
{
  const TissueMap map = randomMap(8, { 4, 5, 4 }, 2, { 2, 2, 2 });
  expectFaithful(map, uniformScale(0.6), 45);
  expectFaithful(map, radialScale(map.grid, map.grid.gridToWorld({ 0, 0, 0 }), 0.5, 4, 1, 2), 45);
}

TEST(KuhnLattice, IsFaithfulToSlices)
{
  // Cells of 0.98 x 0.98 x 2.5 / 3: the worst angle is that of the Kuhn tetrahedron of such a box.
  const TissueMap map = randomMap(9, { 7, 8, 5 }, 3, { 0.98, 0.98, 2.5 });
  expectFaithful(map, uniformScale(3), 40);
  expectFaithful(map, radialScale(map.grid, map.grid.gridToWorld({ 3, 3, 5 }), 0.5, 4, 1, 2), 40);
  expectFaithful(randomMap(10, { 5, 7, 6 }, 3, { 3, 0.7, 0.7 }), uniformScale(1.5), 40);
}

TEST(KuhnLattice, SurroundsATissueThatFillsTheMap)
{
  for (const std::array<int, 3>& size : { std::array<int, 3>{ 1, 1, 1 }, { 5, 1, 3 }, { 6, 6, 6 } })
    expectFaithful(paintedMap(size, [](int, int, int) { return 7; }), uniformScale(2), 45);
  const KuhnLattice lattice =
    kuhnLattice(paintedMap({ 4, 4, 4 }, [](int, int, int) { return 1; }), uniformScale(2), {});
  for (int axis = 0; axis < 3; ++axis)
  {
    double low = 0, high = 0;
    for (const Vec3& p : lattice.background.mesh.points) low = std::min(low, p[axis]), high = std::max(high, p[axis]);
    EXPECT_LT(low, -2.5);
    EXPECT_GT(high, 5.5);
  }
}

TEST(KuhnLattice, IsFinerWhereTheScaleIsSmaller)
{
  const TissueMap map = paintedMap({ 24, 24, 24 }, [](int, int, int) { return 1; });
  const auto tissueTetrahedra = [&](double length)
  { return withoutOutside(kuhnLattice(map, uniformScale(length), {}).background.mesh).tetrahedra.size(); };
  EXPECT_GT(tissueTetrahedra(1), 4 * tissueTetrahedra(2));
  EXPECT_GT(tissueTetrahedra(2), 2 * tissueTetrahedra(8));
  for (double length : { 1.0, 2.0, 4.0 })
  {
    const TetMesh mesh = withoutOutside(kuhnLattice(map, uniformScale(length), {}).background.mesh);
    double longest = 0;
    for (const auto& tet : mesh.tetrahedra)
    {
      for (const auto& [a, b] : kEdgeCorners)
        longest = std::max(longest, norm(mesh.points[tet[a]] - mesh.points[tet[b]]));
    }
    EXPECT_LE(longest, std::sqrt(3.0) * length + 1e-9) << "the diagonal of a cube";
  }
}

TEST(KuhnLattice, GoesNoDeeperThanAllowed)
{
  const TissueMap map = paintedMap({ 2, 2, 2 }, [](int, int, int) { return 1; });
  LatticeOptions options;
  std::array<std::size_t, 3> sizes;
  for (int levels = 0; levels < 3; ++levels)
  {
    options.mostLevelsBelowVoxel = levels;
    expectFaithful(map, uniformScale(0.01), 45, options);
    sizes[levels] = withoutOutside(kuhnLattice(map, uniformScale(0.01), options).background.mesh).tetrahedra.size();
  }
  EXPECT_EQ(sizes[0], 8u * 6);
  EXPECT_EQ(sizes[1], 8u * sizes[0]);
  EXPECT_EQ(sizes[2], 8u * sizes[1]);
}

TEST(KuhnLattice, RefusesMoreCellsThanCanBeNumbered)
{
  TissueMap map;
  map.grid.size = { 2000, 2000, 1 };
  map.grid.spacing = { 1, 1, 600 };
  map.labels.assign(map.grid.voxelCount(), 1);
  EXPECT_THROW(kuhnLattice(map, uniformScale(0.2), {}), EngineError);
}

TEST(KuhnLattice, BytesDoNotDependOnThreads)
{
  const TissueMap map = randomMap(11, { 40, 9, 36 }, 4);
  const ScaleField scale = radialScale(map.grid, map.grid.gridToWorld({ 5, 5, 5 }), 0.7, 5, 3, 10);
  vtkSMPTools::Initialize(1);
  const KuhnLattice alone = kuhnLattice(map, scale, {});
  vtkSMPTools::Initialize(2);
  const KuhnLattice both = kuhnLattice(map, scale, {});
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(alone.background.mesh.points, both.background.mesh.points);
  EXPECT_EQ(alone.background.mesh.tetrahedra, both.background.mesh.tetrahedra);
  EXPECT_EQ(alone.background.mesh.labels, both.background.mesh.labels);
  EXPECT_EQ(alone.background.lengths, both.background.lengths);
  EXPECT_EQ(alone.interfaceFaces, both.interfaceFaces);
  ASSERT_EQ(alone.background.samples.size(), both.background.samples.size());
  for (std::size_t e = 0; e < alone.background.samples.size(); ++e)
    EXPECT_TRUE(alone.background.samples[e].position == both.background.samples[e].position);
}

} // namespace surgicalmesher
