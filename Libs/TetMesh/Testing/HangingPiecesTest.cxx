// SPDX-License-Identifier: Apache-2.0
#include "HangingPieces.h"

#include "VoxelMesh.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// Two voxels side by side, twelve tetrahedra, that share a square: two faces.
TetMesh twoCubes()
{
  return tetrahedraOf(paintedMap({ 2, 1, 1 }, [](int, int, int) { return 5; }), 0);
}

/// The second one has a corner of that square, one that only one of both faces has, to itself.
TetMesh twoCubesByOneFace()
{
  TetMesh mesh = twoCubes();
  constexpr std::int32_t corner = 1 + 3; // at (1, 1, 0), off the diagonal of the square from (1, 0, 0) to (1, 1, 1)
  mesh.points.push_back(mesh.points[corner] + Vec3{ 0.1, 0, 0 });
  for (std::size_t t = 6; t < 12; ++t)
    for (std::int32_t& p : mesh.tetrahedra[t])
    {
      if (p == corner) p = std::int32_t(mesh.points.size()) - 1;
    }
  return mesh;
}

/// A tetrahedron of this label on the face that the diagonal of a lone voxel's lower side parts off.
TetMesh cubeWithFin(Label label, const std::array<std::int32_t, 3>& face)
{
  TetMesh mesh = tetrahedraOf(paintedMap({ 1, 1, 1 }, [](int, int, int) { return 5; }), 0);
  mesh.points.push_back({ 0, 0, -2 });
  std::array<std::int32_t, 4> fin{ face[0], face[1], face[2], 8 };
  const auto& p = mesh.points;
  if (orient(p[fin[0]], p[fin[1]], p[fin[2]], p[fin[3]]) < 0) std::swap(fin[0], fin[1]);
  mesh.tetrahedra.push_back(fin);
  mesh.labels.push_back(label);
  return mesh;
}

constexpr double half = 0.5; // of a tissue

} // namespace

TEST(HangingPieces, ACubeThatOneFaceHoldsIsOne)
{
  const TetMesh mesh = twoCubesByOneFace();
  const std::vector<HangingPiece> pieces = hangingPieces(mesh, half);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].label, 5);
  EXPECT_EQ(pieces[0].tetrahedra, 6u);
  EXPECT_NEAR(pieces[0].volume, 1, 0.1);
  EXPECT_NEAR(std::abs(pieces[0].place.x - 0.5), 0.5, 0.1);
  EXPECT_TRUE(pieces[0].isFree);
  EXPECT_TRUE(hangingPieces(mesh, 0.4).empty()) << "it is larger";
}

TEST(HangingPieces, ACubeThatTwoFacesHoldIsNone) { EXPECT_TRUE(hangingPieces(twoCubes(), half).empty()); }

TEST(HangingPieces, OneTetrahedronIsAlwaysSmall)
{
  const TetMesh mesh = cubeWithFin(5, { 0, 1, 3 });
  const std::vector<HangingPiece> pieces = hangingPieces(mesh, 0);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].tetrahedra, 1u);
  EXPECT_NEAR(pieces[0].volume, 1.5 / 6, 1e-9);
  EXPECT_NEAR(pieces[0].place.z, (-3 * 0.5 - 2) / 4, 1e-9);
}

TEST(HangingPieces, AnotherTissueHoldsItToo)
{
  TetMesh mesh = cubeWithFin(5, { 0, 1, 3 });
  EXPECT_TRUE(hangingPieces(mesh).at(0).isFree);
  mesh.points.push_back({ 2, -2, -2 }); // of a tetrahedron on one of its sides
  const auto& p = mesh.points;
  std::array<std::int32_t, 4> beside{ 0, 1, 8, 9 };
  if (orient(p[beside[0]], p[beside[1]], p[beside[2]], p[beside[3]]) < 0) std::swap(beside[0], beside[1]);
  mesh.tetrahedra.push_back(beside);
  mesh.labels.push_back(0);
  EXPECT_TRUE(hangingPieces(mesh).at(0).isFree) << "the outside holds nothing";
  mesh.labels.back() = 6;
  ASSERT_EQ(hangingPieces(mesh).size(), 1u);
  EXPECT_FALSE(hangingPieces(mesh)[0].isFree);
}

TEST(HangingPieces, NeitherOtherTissuesNorTheOutsideCount)
{
  EXPECT_TRUE(hangingPieces(cubeWithFin(6, { 0, 1, 3 }), half).empty()) << "a tissue of its own";
  EXPECT_TRUE(hangingPieces(cubeWithFin(0, { 0, 1, 3 }), half).empty());
}

TEST(HangingPieces, AStrandIsOnePieceFromWhicheverEndTheSearchBegins)
{
  TetMesh mesh = cubeWithFin(5, { 0, 1, 3 });
  for (int n = 0; n < 2; ++n) // on, with a new tip each
  {
    const auto fin = mesh.tetrahedra.back();
    const Vec3 tip = mesh.points.back() + Vec3{ 0, 0, -1 };
    mesh.points.push_back(tip);
    std::array<std::int32_t, 4> next{ fin[0], fin[1], std::int32_t(mesh.points.size()) - 2,
                                      std::int32_t(mesh.points.size()) - 1 };
    const auto& p = mesh.points;
    if (orient(p[next[0]], p[next[1]], p[next[2]], p[next[3]]) < 0) std::swap(next[0], next[1]);
    mesh.tetrahedra.push_back(next);
    mesh.labels.push_back(5);
  }
  TetMesh reversed = mesh;
  std::reverse(reversed.tetrahedra.begin(), reversed.tetrahedra.end());
  for (const TetMesh& each : { mesh, reversed })
  {
    const std::vector<HangingPiece> pieces = hangingPieces(each, half);
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0].tetrahedra, 3u);
    EXPECT_TRUE(pieces[0].isFree);
    const std::vector<HangingPiece> tips = hangingPieces(each, 0);
    ASSERT_EQ(tips.size(), 1u);
    EXPECT_EQ(tips[0].tetrahedra, 1u);
  }
}

TEST(HangingPieces, ALongStrandNeedsNoDeepStack)
{
  TetMesh mesh;
  constexpr int count = 200000;
  for (int n = 0; n < count + 3; ++n)
  {
    const double turn = 2 * std::acos(-1.0) / 3 * n; // around a helix
    mesh.points.push_back({ std::cos(turn), std::sin(turn), 0.5 * n });
  }
  for (std::int32_t n = 0; n < count; ++n)
  {
    mesh.tetrahedra.push_back({ n, n + 1, n + 2, n + 3 });
    mesh.labels.push_back(1);
  }
  const std::vector<HangingPiece> pieces = hangingPieces(mesh, 0.02);
  ASSERT_EQ(pieces.size(), 2u) << "both ends";
  for (const HangingPiece& piece : pieces) EXPECT_EQ(piece.tetrahedra, 0.02 * count);
}
