// SPDX-License-Identifier: Apache-2.0
// Critical steps against the dense eigenvalues of one element, and the list of the smallest tetrahedra on slabs.

#include "ExplicitStep.h"
#include "ConstitutiveTags.h"
#include "FaceAdjacency.h"
#include "MeshQuality.h"
#include "SmallestTetrahedra.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <vtkMath.h>

#include <random>

namespace surgicalmesher
{
namespace
{

using namespace test;

/// 2 / omega by the stiffness matrix of 12 unknowns, put together from displacements of single corners.
double denseStep(const std::array<Vec3, 4>& p, const TissueMaterial& material)
{
  const double e = material.youngsModulus, nu = material.poissonsRatio;
  const double lambda = e * nu / ((1 + nu) * (1 - 2 * nu)), mu = e / (2 * (1 + nu));
  const double volume = orient(p[0], p[1], p[2], p[3]) / 6;
  const auto gradientOf = [&](int c, int axis)
  {
    const Vec3 normal = cross(p[(c + 2) % 4] - p[(c + 1) % 4], p[(c + 3) % 4] - p[(c + 1) % 4]);
    const Vec3 g = normal / dot(normal, p[c] - p[(c + 1) % 4]);
    std::array<Vec3, 3> displacement{};
    displacement[axis] = g;
    return displacement;
  };
  const auto strain = [](const std::array<Vec3, 3>& u, int i, int j) { return 0.5 * (u[i][j] + u[j][i]); };
  std::vector<std::array<double, 12>> k(12), vectors(12);
  std::vector<double*> rows, columns;
  for (int a = 0; a < 12; ++a)
  {
    for (int b = 0; b < 12; ++b)
    {
      const auto u = gradientOf(a / 3, a % 3), v = gradientOf(b / 3, b % 3);
      double energy = 0, traceU = 0, traceV = 0;
      for (int i = 0; i < 3; ++i)
      {
        traceU += u[i][i], traceV += v[i][i];
        for (int j = 0; j < 3; ++j) energy += 2 * mu * strain(u, i, j) * strain(v, i, j);
      }
      k[a][b] = volume * (energy + lambda * traceU * traceV);
    }
    rows.push_back(k[a].data()), columns.push_back(vectors[a].data());
  }
  std::array<double, 12> values{};
  vtkMath::JacobiN(rows.data(), 12, values.data(), columns.data());
  return 2 / std::sqrt(values[0] / (material.density * volume / 4));
}

std::array<Vec3, 4> randomCorners(std::mt19937& random)
{
  const auto number = [&] { return double(random()) / 4294967296.0; };
  for (;;)
  {
    std::array<Vec3, 4> p;
    for (Vec3& x : p) x = { number(), number(), number() };
    if (orient(p[0], p[1], p[2], p[3]) > 0.01) return p;
  }
}

/// Two tissues side by side along z: a layer of voxels of `thin` mm, and a block that is far thicker.
MeshFile layerOnBlock(double thin)
{
  MeshFile content;
  content.mesh = withoutOutside(tetrahedraOf(paintedMap({ 6, 6, 8 }, [](int, int, int k) { return k == 7 ? 2 : 1; })));
  double top = -1e9;
  for (const Vec3& p : content.mesh.points) top = std::max(top, p.z);
  for (Vec3& p : content.mesh.points)
    if (p.z == top) p.z = top - 1 + thin;
  content.targetEdgeLength.assign(content.mesh.points.size(), 1.0);
  content.constitutive.assign(content.mesh.tetrahedra.size(), kLinear);
  return content;
}

} // namespace

TEST(ExplicitStep, IsThatOfTheDenseElement)
{
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i)
  {
    TissueMaterial material;
    material.poissonsRatio = -0.4 + 0.0088 * i;
    const auto corners = randomCorners(random);
    const double expected = denseStep(corners, material);
    EXPECT_NEAR(criticalStep(corners, material), expected, 1e-9 * expected);
  }
}

TEST(ExplicitStep, GrowsWithSizeAndShrinksWithTheSpeedOfWaves)
{
  std::mt19937 random(4);
  const auto corners = randomCorners(random);
  auto twice = corners;
  for (Vec3& p : twice) p = 2 * p;
  TissueMaterial soft, stiff;
  stiff.youngsModulus = 4 * soft.youngsModulus;
  EXPECT_NEAR(criticalStep(twice, soft), 2 * criticalStep(corners, soft), 1e-12);
  EXPECT_NEAR(criticalStep(corners, stiff), 0.5 * criticalStep(corners, soft), 1e-12);
}

TEST(ExplicitStep, IsTheTissuesOwnAndLeavesOutWhatIsHeld)
{
  MeshFile content = layerOnBlock(0.2);
  const auto steps = explicitSteps(content, {});
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_LT(steps.at(2).leastHeight, 0.2 + 1e-9);
  EXPECT_LT(steps.at(2).step, 0.5 * steps.at(1).step);
  TissueMaterial stiff;
  stiff.youngsModulus *= 1e4;
  const auto withStiff = explicitSteps(content, { { 1, stiff } });
  EXPECT_NEAR(withStiff.at(1).step, 0.01 * steps.at(1).step, 1e-9 * steps.at(1).step);
  EXPECT_EQ(withStiff.at(2).step, steps.at(2).step);
  for (std::size_t t = 0; t < content.mesh.labels.size(); ++t)
    if (content.mesh.labels[t] == 2) content.constitutive[t] = kNullDisplacement;
  const auto held = explicitSteps(content, {});
  EXPECT_EQ(held.at(2).step, 0);
  EXPECT_EQ(held.at(2).leastHeight, steps.at(2).leastHeight);
  EXPECT_EQ(held.at(1).step, steps.at(1).step);
  EXPECT_EQ(smallestStep(steps), steps.at(2).step);
  EXPECT_EQ(smallestStep(held), steps.at(1).step);
}

TEST(SmallestTetrahedra, AreTheSmallestInOrder)
{
  const MeshFile content = layerOnBlock(0.5);
  const auto smallest = smallestTetrahedra(content, 50);
  ASSERT_EQ(smallest.size(), 50u);
  for (std::size_t i = 0; i < smallest.size(); ++i)
  {
    const auto& [a, b, c, d] = content.mesh.tetrahedra[smallest[i].tetrahedron];
    const auto& p = content.mesh.points;
    EXPECT_EQ(smallest[i].height, leastHeight(p[a], p[b], p[c], p[d]));
    if (i > 0)
    {
      EXPECT_GE(smallest[i].height, smallest[i - 1].height);
    }
  }
  EXPECT_EQ(smallestTetrahedra(content, 1 << 20).size(), content.mesh.tetrahedra.size());
}

TEST(SmallestTetrahedra, SayWhy)
{
  MeshFile content = layerOnBlock(0.3);
  for (const SmallTetrahedron& small : smallestTetrahedra(content, 1 << 20))
  {
    const bool inLayer = content.mesh.labels[small.tetrahedron] == 2;
    if (small.reason == SmallBecause::ThinTissue)
    {
      EXPECT_TRUE(inLayer);
    }
    if (inLayer)
    {
      EXPECT_TRUE(small.reason == SmallBecause::ThinTissue || small.reason == SmallBecause::Junction);
    }
    if (small.reason == SmallBecause::Inside)
    {
      EXPECT_GT(small.thickness, 1.0);
    }
  }
  for (std::size_t t = 0; t < content.mesh.labels.size(); ++t)
    if (content.mesh.labels[t] == 2) content.constitutive[t] = kNullDisplacement;
  for (const SmallTetrahedron& small : smallestTetrahedra(content, 1 << 20))
    EXPECT_EQ(small.reason == SmallBecause::NullDisplacement, content.mesh.labels[small.tetrahedron] == 2);
}

} // namespace surgicalmesher
