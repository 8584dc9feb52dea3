// SPDX-License-Identifier: Apache-2.0
#include "Bending.h"
#include "ComplexInvariants.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <functional>

namespace surgicalmesher
{
namespace
{

using namespace test;

TetComplex complexOf(const std::function<int(int i, int j, int k)>& paint)
{
  const TetMesh mesh = tetrahedraOf(paintedMap({ 6, 6, 6 }, paint));
  return TetComplex(mesh.points, std::vector<float>(mesh.points.size(), 1), mesh.tetrahedra, mesh.labels);
}

std::int32_t vertexAt(const TetComplex& complex, const Vec3& p)
{
  for (std::size_t v = 0; v < complex.points.size(); ++v)
    if (norm(complex.points[v] - p) < 1e-9) return std::int32_t(v);
  return -1;
}

Quadric bendingAt(TetComplex& complex, std::int32_t v, const Vec3& p)
{
  return bendingOf(complex, v, p, sheetOf(complex, v));
}

const auto lowerHalf = [](int, int, int k) { return k < 3 ? 1 : 0; };

TEST(Bending, OfAPlaneIsNone)
{
  TetComplex complex = complexOf(lowerHalf);
  const Vec3 p{ 2.5, 2.5, 2.5 };
  const Quadric bending = bendingAt(complex, vertexAt(complex, p), p);
  EXPECT_GT(bending.trace(), 0);
  EXPECT_NEAR(norm(bending.g), 0, 1e-12);
}

TEST(Bending, BringsAVertexBackToThePlane)
{
  TetComplex complex = complexOf(lowerHalf);
  const Vec3 p{ 2.5, 2.5, 2.5 };
  const std::int32_t v = vertexAt(complex, p);
  for (const double height : { -0.3, 0.01, 0.2 })
  {
    const Quadric bending = bendingAt(complex, v, p + Vec3{ 0, 0, height });
    EXPECT_NEAR(bending.solve(bending.g).z, -height, 0.05 * std::abs(height)) << height;
  }
}

/// Two tissues on a common plane: the outer surface goes on across their junction, the sheet between them ends there.
TEST(Bending, GoesOnAcrossJunctionsOnTheOuterSurfaceOnly)
{
  TetComplex complex = complexOf([](int i, int, int k) { return k >= 3 ? 0 : i < 3 ? 1 : 2; });
  const Vec3 p{ 2.5, 2.5, 2.5 };
  const std::int32_t v = vertexAt(complex, p);
  EXPECT_NEAR(norm(bendingAt(complex, v, p).g), 0, 1e-12);
  const Quadric raised = bendingAt(complex, v, p + Vec3{ 0, 0, 0.1 });
  EXPECT_LT(raised.g.z, 0);
  EXPECT_GT(std::abs(raised.g.z), 5 * std::abs(raised.g.x));
}

} // namespace
} // namespace surgicalmesher
