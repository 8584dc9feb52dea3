// SPDX-License-Identifier: Apache-2.0
// The conditioning of the stiffness matrix against its dense eigenvalues, on meshes that are small enough to have them.

#include "StiffnessConditioning.h"
#include "FaceAdjacency.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <vtkMath.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace surgicalmesher
{
namespace
{

using namespace test;

/// A box of voxels whose points are shaken by up to `shake`; no two alike.
TetMesh shakenBox(const std::array<int, 3>& size, double shake, const Vec3& stretch = { 1, 1, 1 })
{
  TetMesh mesh = withoutOutside(tetrahedraOf(paintedMap(size, [](int, int, int) { return 1; })));
  std::mt19937 random(7);
  const auto next = [&] { return shake * (double(random()) / 2147483648.0 - 1); };
  for (Vec3& p : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis) p[axis] = (p[axis] + next()) * stretch[axis];
  }
  return mesh;
}

/// Strains (xx, yy, zz, xy, yz, zx) of displacing corner c along an axis: rows of the textbook's B.
std::array<double, 6> strainOf(const Vec3& gradient, int axis)
{
  const Vec3 g = gradient;
  if (axis == 0) return { g.x, 0, 0, g.y, 0, g.z };
  if (axis == 1) return { 0, g.y, 0, g.x, g.z, 0 };
  return { 0, 0, g.z, 0, g.y, g.x };
}

/// Gradient of the linear function that is 1 at corner c and 0 at the three others.
Vec3 gradientAt(const TetMesh& mesh, std::size_t t, int c)
{
  const auto& ids = mesh.tetrahedra[t];
  const auto p = [&](int k) { return mesh.points[ids[(c + k) % 4]]; };
  const Vec3 normal = cross(p(2) - p(1), p(3) - p(1));
  return normal / dot(normal, p(0) - p(1));
}

/// B^T D B over all tetrahedra, scaled to a unit diagonal, without the lowest `held` points.
std::vector<std::vector<double>> scaledStiffness(const TetMesh& mesh, std::size_t held)
{
  const double nu = 0.4, lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 0.5 / (1 + nu);
  std::vector<std::int32_t> order(mesh.points.size()), number(mesh.points.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return mesh.points[a].z < mesh.points[b].z; });
  for (std::size_t i = held; i < order.size(); ++i) number[order[i]] = static_cast<std::int32_t>(i - held);
  const std::size_t n = 3 * (mesh.points.size() - held);
  std::vector<std::vector<double>> k(n, std::vector<double>(n, 0));
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    const double volume = orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) / 6;
    for (int i = 0; i < 12; ++i)
    {
      const auto e = strainOf(gradientAt(mesh, t, i / 3), i % 3);
      for (int j = 0; j < 12; ++j)
      {
        const std::int32_t row = number[mesh.tetrahedra[t][i / 3]], column = number[mesh.tetrahedra[t][j / 3]];
        if (row < 0 || column < 0) continue;
        const auto f = strainOf(gradientAt(mesh, t, j / 3), j % 3);
        double energy = lambda * (e[0] + e[1] + e[2]) * (f[0] + f[1] + f[2]);
        for (int s = 0; s < 6; ++s) energy += (s < 3 ? 2 : 1) * mu * e[s] * f[s];
        k[3 * row + i % 3][3 * column + j % 3] += volume * energy;
      }
    }
  }
  std::vector<double> scale(n);
  for (std::size_t i = 0; i < n; ++i) scale[i] = 1 / std::sqrt(k[i][i]);
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = 0; j < n; ++j) k[i][j] *= scale[i] * scale[j];
  }
  return k;
}

/// Descending.
std::vector<double> eigenvaluesOf(std::vector<std::vector<double>> matrix)
{
  const std::size_t n = matrix.size();
  std::vector<std::vector<double>> vectors(n, std::vector<double>(n));
  std::vector<double*> rows(n), vectorRows(n);
  for (std::size_t i = 0; i < n; ++i) rows[i] = matrix[i].data(), vectorRows[i] = vectors[i].data();
  std::vector<double> values(n);
  vtkMath::JacobiN(rows.data(), static_cast<int>(n), values.data(), vectorRows.data());
  return values;
}

} // namespace

TEST(StiffnessConditioning, IsThatOfTheDenseMatrix)
{
  struct Case
  {
    TetMesh mesh;
    std::size_t held;
  };
  const std::vector<Case> cases{ { shakenBox({ 1, 1, 1 }, 0.1), 3 },
                                 { shakenBox({ 2, 2, 2 }, 0.15), 3 },
                                 { shakenBox({ 3, 2, 2 }, 0.2, { 1, 2, 1 }), 3 },
                                 { shakenBox({ 1, 1, 6 }, 0.1, { 1, 1, 3 }), 3 } };
  for (const auto& [mesh, held] : cases)
  {
    const StiffnessConditioning found = stiffnessConditioning(mesh);
    EXPECT_TRUE(found.converged);
    EXPECT_EQ(found.unknowns, 3 * (mesh.points.size() - held));
    const std::vector<double> expected = eigenvaluesOf(scaledStiffness(mesh, held));
    EXPECT_NEAR(found.largestEigenvalue, expected.front(), 1e-6 * expected.front());
    EXPECT_NEAR(found.smallestEigenvalue, expected.back(), 1e-4 * expected.back());
    EXPECT_EQ(found.condition, found.largestEigenvalue / found.smallestEigenvalue);
    EXPECT_NEAR(found.iterationsPerCubeRoot * std::cbrt(double(found.unknowns)), found.iterations, 1e-6);
    EXPECT_GT(found.iterations, 5);
    EXPECT_LE(found.iterations, 3 * int(found.unknowns));
  }
}

TEST(StiffnessConditioning, DependsOnShapesNotOnSize)
{
  const StiffnessConditioning fine = stiffnessConditioning(shakenBox({ 5, 4, 6 }, 0.1));
  const StiffnessConditioning large = stiffnessConditioning(shakenBox({ 5, 4, 6 }, 0.1, { 16, 16, 16 }));
  EXPECT_EQ(fine.unknowns, large.unknowns);
  EXPECT_NEAR(large.condition, fine.condition, 1e-6 * fine.condition);
  const StiffnessConditioning slender = stiffnessConditioning(shakenBox({ 5, 4, 18 }, 0.1));
  EXPECT_GT(slender.condition, 3 * fine.condition);
  EXPECT_GT(slender.iterations, fine.iterations);
}

/// A block of 20 x 20 x 8 voxels, and a strand of one voxel beside the middle of one side.
TEST(StiffnessConditioning, NamesTheStrandThatSwings)
{
  const auto blockWithStrand = [](int length)
  {
    return withoutOutside(tetrahedraOf(
      paintedMap({ 20 + length, 20, 8 }, [](int i, int j, int k) { return i < 20              ? 1
                                                                          : j == 10 && k == 4 ? 2
                                                                                              : 0; })));
  };
  EXPECT_TRUE(stiffnessConditioning(blockWithStrand(0)).localModes.empty());
  const TetMesh mesh = blockWithStrand(5);
  const StiffnessConditioning found = stiffnessConditioning(mesh);
  ASSERT_FALSE(found.localModes.empty());
  double end = -1e9;
  for (const Vec3& p : mesh.points) end = std::max(end, p.x);
  const LocalMode& lowest = found.localModes.front();
  EXPECT_EQ(lowest.label, 2);
  EXPECT_GT(lowest.place.x, end - 5);
  EXPECT_LT(lowest.place.x, end);
  EXPECT_LT(lowest.nodeShare, kLocalShare);
  EXPECT_NEAR(lowest.eigenvalue, found.smallestEigenvalue, 1e-6 * lowest.eigenvalue);
}

TEST(StiffnessConditioning, HoldsEveryPiece)
{
  const auto boxes = [](int gap)
  {
    return withoutOutside(
      tetrahedraOf(paintedMap({ 4 + gap, 3, 3 }, [=](int i, int, int) { return i < 2 || i >= 2 + gap; })));
  };
  const StiffnessConditioning together = stiffnessConditioning(boxes(0)), apart = stiffnessConditioning(boxes(1));
  EXPECT_TRUE(together.converged);
  EXPECT_TRUE(apart.converged);
  EXPECT_GT(apart.unknowns, together.unknowns);
}

TEST(StiffnessConditioning, TellsOfMeshesThatSwing)
{
  TetMesh mesh = shakenBox({ 6, 1, 1 }, 0);
  for (Vec3& p : mesh.points) p = { p.x, p.y - p.z, p.y + p.z };
  const StiffnessConditioning onItsEdge = stiffnessConditioning(mesh);
  EXPECT_FALSE(onItsEdge.converged);
  EXPECT_EQ(onItsEdge.condition, 0);
}

TEST(StiffnessConditioning, TakesTheSmallestMeshes)
{
  TetMesh one;
  one.points = { {}, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  one.tetrahedra = { { 0, 1, 2, 3 } };
  one.labels = { 1 };
  const StiffnessConditioning single = stiffnessConditioning(one);
  EXPECT_EQ(single.unknowns, 3u);
  EXPECT_TRUE(single.converged);
  for (Vec3& p : one.points) p.z = -p.z;
  std::swap(one.tetrahedra[0][0], one.tetrahedra[0][1]);
  EXPECT_EQ(stiffnessConditioning(one).unknowns, 0u) << "all but the lowest are at the same height";
}

TEST(StiffnessConditioning, DoesNotDependOnThreads)
{
  const TetMesh mesh = shakenBox({ 9, 8, 7 }, 0.2);
  vtkSMPTools::Initialize(1);
  const StiffnessConditioning one = stiffnessConditioning(mesh);
  vtkSMPTools::Initialize(3);
  const StiffnessConditioning three = stiffnessConditioning(mesh);
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(one.iterations, three.iterations);
  EXPECT_EQ(one.condition, three.condition);
}

} // namespace surgicalmesher
