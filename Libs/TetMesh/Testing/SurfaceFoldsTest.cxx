// SPDX-License-Identifier: Apache-2.0
#include "SurfaceFolds.h"

#include "Shapes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

bool nowhere(Label, const Vec3&) { return false; }
bool everywhere(Label, const Vec3&) { return true; }

/// A prism along y with this outline in x and z, counter-clockwise seen from -y, whose first corner sees all others:
/// `labels` of the wedges between them.
SurfaceComplex prism(const std::vector<std::array<double, 2>>& outline, const std::vector<Label>& labels, double length)
{
  SurfaceComplex surface;
  const auto count = std::int32_t(outline.size());
  for (const double y : { 0.0, length })
    for (const auto& [x, z] : outline) surface.points.push_back({ x, y, z });
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c, Label behind, Label front)
  {
    surface.triangles.push_back({ a, b, c });
    surface.labels.push_back({ behind, front });
  };
  const auto addWall = [&](std::int32_t a, std::int32_t b, Label behind, Label front)
  {
    add(a, b + count, b, behind, front);
    add(a, a + count, b + count, behind, front);
  };
  addWall(0, 1, labels.front(), 0);
  for (std::int32_t n = 1; n + 1 < count; ++n)
  {
    const Label label = labels[n - 1];
    add(0, n, n + 1, label, 0);
    add(count, count + n + 1, count + n, label, 0);
    addWall(n, n + 1, label, 0);
    if (n > 1 && labels[n - 2] != label) addWall(n, 0, labels[n - 2], label);
  }
  addWall(count - 1, 0, labels.back(), 0);
  return surface;
}

/// A box, 10 wide and 8 high, with a slit down its middle, 1 wide above and 6 deep, whose bottom is the first corner.
SurfaceComplex slitBox(Label left, Label right)
{
  const std::vector<std::array<double, 2>> outline{ { 5, 2 },  { 4.5, 8 }, { 0, 8 },  { 0, 0 },
                                                    { 10, 0 }, { 10, 8 },  { 5.5, 8 } };
  return prism(outline, { left, left, right, right, right }, 4);
}

std::vector<Vec3> normalsOf(const SurfaceComplex& surface)
{
  std::vector<Vec3> normals;
  for (const auto& [a, b, c] : surface.triangles)
  {
    const Vec3 n = cross(surface.points[b] - surface.points[a], surface.points[c] - surface.points[a]);
    normals.push_back(n / norm(n));
  }
  return normals;
}

} // namespace

TEST(SurfaceFolds, ABallHasNone)
{
  const SurfaceFolds found = surfaceFolds(sphere({ 1, 2, 3 }, 5, 3), {}, everywhere);
  EXPECT_TRUE(found.folds.empty());
  EXPECT_EQ(found.sheets.folded, 0);
  EXPECT_EQ(found.outer.folded, 0);
  EXPECT_GT(found.sheets.length, 0);
  EXPECT_EQ(found.sheets.length, found.outer.length);
}

TEST(SurfaceFolds, RightAnglesAreNone)
{
  const TissueMap map = paintedMap({ 4, 3, 3 }, [](int i, int, int) { return i < 2 ? 1 : 2; }, { 0.7, 1.3, 0.9 });
  EXPECT_TRUE(surfaceFolds(interfaceOf(tetrahedraOf(map)), {}, everywhere).folds.empty());
}

TEST(SurfaceFolds, ASlitIsACrackAlongItsBottom)
{
  const SurfaceFolds found = surfaceFolds(slitBox(3, 3), {}, everywhere);
  ASSERT_EQ(found.folds.size(), 1u);
  const Fold& crack = found.folds[0];
  EXPECT_TRUE(crack.isOuter);
  EXPECT_TRUE(crack.isConcave);
  EXPECT_EQ(crack.labels, (std::array<Label, 2>{ 3, 3 }));
  EXPECT_EQ(crack.reason, FoldReason::Crack);
  EXPECT_NEAR(crack.length, 4, 1e-12);
  EXPECT_LT(norm(crack.place - Vec3{ 5, 2, 2 }), 1e-12);
  EXPECT_EQ(crack.boundaryTurn, -1);
  EXPECT_NEAR(found.outer.folded, 4, 1e-12);
  EXPECT_NEAR(found.sheets.folded, 4, 1e-12);
}

TEST(SurfaceFolds, BetweenTwoTissuesItIsAGroove)
{
  const SurfaceFolds found = surfaceFolds(slitBox(9, 3), {}, everywhere);
  ASSERT_EQ(found.folds.size(), 1u);
  EXPECT_TRUE(found.folds[0].isConcave);
  EXPECT_EQ(found.folds[0].labels, (std::array<Label, 2>{ 3, 9 }));
  EXPECT_EQ(found.folds[0].reason, FoldReason::Groove);
  EXPECT_NEAR(found.outer.folded, 4, 1e-12);
  EXPECT_EQ(found.sheets.folded, 0) << "it is in no sheet";
}

TEST(SurfaceFolds, AnEdgeIsThatOfAThinTissueOrInTheMapOrTheSurfacesOwn)
{
  const SurfaceComplex wedge = prism({ { 0, 0 }, { 8, -2 }, { 8, 2 } }, { 4 }, 5);
  const auto reasonOf = [&](const std::vector<Vec3>& normals, const IsThin& isThin)
  {
    const SurfaceFolds found = surfaceFolds(wedge, normals, isThin);
    const auto tip = std::find_if(found.folds.begin(), found.folds.end(),
                                  [](const Fold& fold) {
                                    return norm(fold.place - Vec3{ 0, 2.5, 0 }) < 1e-9;
                                  });
    EXPECT_NE(tip, found.folds.end());
    EXPECT_FALSE(tip->isConcave);
    return tip->reason;
  };
  std::vector<Vec3> normals = normalsOf(wedge);
  EXPECT_EQ(reasonOf({}, nowhere), FoldReason::Surface);
  EXPECT_EQ(reasonOf(normals, nowhere), FoldReason::Boundary);
  EXPECT_EQ(reasonOf(normals, everywhere), FoldReason::ThinTissue);
  EXPECT_EQ(reasonOf(normals, [](Label label, const Vec3&) { return label != 4; }), FoldReason::Boundary);
  normals.assign(normals.size(), { 1, 0, 0 });
  EXPECT_EQ(reasonOf(normals, nowhere), FoldReason::Surface);
}

TEST(SurfaceFolds, InsideItIsTheSharpTissuesEdgeWhicheverLabelIsLarger)
{
  for (const Label tip : { Label(2), Label(7) })
  {
    SurfaceComplex wedge = prism({ { 0, 0 }, { 8, -2 }, { 8, 2 } }, { tip }, 5);
    const Label around = tip == 2 ? 7 : 2;
    for (std::size_t t = 0; t < wedge.triangles.size(); ++t)
    {
      wedge.labels[t] = { tip, around };
      if (tip > around) continue; // either way round
      std::swap(wedge.triangles[t][1], wedge.triangles[t][2]);
      std::swap(wedge.labels[t][0], wedge.labels[t][1]);
    }
    const SurfaceFolds found = surfaceFolds(wedge, {}, nowhere);
    ASSERT_FALSE(found.folds.empty());
    for (const Fold& fold : found.folds)
    {
      EXPECT_FALSE(fold.isOuter);
      EXPECT_EQ(fold.labels, (std::array<Label, 2>{ tip, around }));
    }
    EXPECT_EQ(found.outer.length, 0);
  }
}

TEST(SurfaceFolds, EdgesThatMeetAreOneAndTheLongestComesFirst)
{
  SurfaceComplex two = slitBox(3, 3);
  SurfaceComplex longer = slitBox(3, 3);
  for (Vec3& p : longer.points) p = { p.x + 20, 2 * p.y, p.z };
  append(two, longer);
  const SurfaceFolds apart = surfaceFolds(two, {}, nowhere);
  ASSERT_EQ(apart.folds.size(), 2u);
  EXPECT_NEAR(apart.folds[0].length, 8, 1e-12);
  EXPECT_NEAR(apart.folds[1].length, 4, 1e-12);

  const SurfaceFolds rings = surfaceFolds(torus(10, 1, 12, 3), {}, nowhere); // a triangle goes round
  ASSERT_EQ(rings.folds.size(), 3u);
  for (const Fold& fold : rings.folds) EXPECT_EQ(fold.edges, 12u);
}

TEST(SurfaceFolds, TakesTheNormalsOfSamplesByTheirFaces)
{
  BackgroundMesh background;
  background.mesh = tetrahedraOf(paintedMap({ 2, 2, 2 }, [](int, int, int) { return 1; }));
  background.neighbours = faceAdjacency(background.mesh).across;
  const std::vector<InterfaceFace> faces = interfaceFaces(background.mesh);
  ASSERT_EQ(faces.size(), interfaceOf(background.mesh).triangles.size());
  for (const std::array<float, 3>& normal : { std::array<float, 3>{ 2, 0, 0 }, { 0, 0.5f, 0 } })
  {
    BackgroundMesh::Sample sample;
    sample.tetrahedron = faces[5].tetrahedron;
    sample.face = faces[5].face;
    sample.normal = normal;
    background.samples.push_back(sample);
  }
  const std::vector<Vec3> normals = boundaryNormals(background);
  ASSERT_EQ(normals.size(), faces.size());
  for (std::size_t n = 0; n < normals.size(); ++n)
    EXPECT_EQ(normals[n], n == 5 ? (Vec3{ 1, 1, 0 }) : (Vec3{ 0, 0, 0 })) << n;
}
