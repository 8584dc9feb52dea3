// SPDX-License-Identifier: Apache-2.0
#include "PartOverlap.h"
#include "Errors.h"
#include "InsideTest.h"
#include "Shapes.h"
#include "Slab.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

TriangleSurface surfaceOf(const SurfaceComplex& complex)
{
  TriangleSurface surface;
  surface.points.resize(3, Eigen::Index(complex.points.size()));
  for (std::size_t i = 0; i < complex.points.size(); ++i)
    surface.points.col(Eigen::Index(i)) << complex.points[i].x, complex.points[i].y, complex.points[i].z;
  surface.triangles.assign(complex.triangles.begin(), complex.triangles.end());
  return surface;
}

Part ball(const Vec3& centre, double radius) { return { "ball", "ball.stl", surfaceOf(sphere(centre, radius, 4)) }; }

double volumeOfBall(double radius) { return 4.0 / 3 * 3.14159265 * radius * radius * radius; }

} // namespace

TEST(InsideTest, IsExactForAHollowBallThroughItsVertices)
{
  SurfaceComplex shells = sphere({ 0, 0, 0 }, 5, 4);
  append(shells, sphere({ 0, 0, 0 }, 2, 4));
  const TriangleSurface surface = surfaceOf(shells);
  const InsideTest inside(surface, "ball");
  // The axis passes through vertices of both balls.
  for (const double z : { -4.9, -2.1, 2.1, 4.9 }) EXPECT_TRUE(inside.contains({ 0, 0, z })) << z;
  for (const double z : { -5.1, -1.9, 0.0, 1.9, 5.1 }) EXPECT_FALSE(inside.contains({ 0, 0, z })) << z;
  EXPECT_NEAR(volumeInside(surface, inside), volumeOfBall(5) - volumeOfBall(2), 0.01 * volumeOfBall(5));
}

TEST(InsideTest, RefusesAnOpenSurface)
{
  TriangleSurface open = ball({ 0, 0, 0 }, 1).surface;
  open.triangles.pop_back();
  try
  {
    InsideTest(open, "muscle.stl");
    FAIL();
  }
  catch (const InputError& error)
  {
    EXPECT_STREQ(error.what(), "muscle.stl: 3 open edges, expected a closed surface");
  }
}

TEST(PartOverlap, AChosenCutOffKeepsTheVolume)
{
  const ElementMesh mesh = slab(80, 64, 10);
  const std::vector<Part> parts{ ball({ 0.3, 0.2, 5 }, 4.5), ball({ 20, 10, 1 }, 4) };
  const Classification classes = classified(mesh, parts, { 0, 0 });
  const double largest = 1.25 * 1.25;
  EXPECT_NEAR(classes.matches[0].elementVolume, volumeOfBall(4.5), 0.01 * volumeOfBall(4.5) + 2 * largest);
  EXPECT_NEAR(classes.matches[0].cutOff, 0.5, 0.1);
  EXPECT_GT(classes.matches[0].recall, 0.8);
  EXPECT_GT(classes.matches[0].precision, 0.8);
  EXPECT_EQ(std::size_t(std::count(classes.part.begin(), classes.part.end(), 2)), classes.matches[1].elements);
}

TEST(PartOverlap, AHigherCutOffTakesFewerAndSurerElements)
{
  const ElementMesh mesh = slab(40, 32, 8);
  const std::vector<Part> part{ ball({ 0, 0, 5 }, 4.5) };
  const PartMatch low = classified(mesh, part, { 0.1 }).matches[0], high = classified(mesh, part, { 0.9 }).matches[0];
  EXPECT_GT(low.elements, high.elements);
  EXPECT_GT(low.recall, 0.95);
  EXPECT_GT(high.precision, 0.95);
}

TEST(PartOverlap, AnElementOfTwoPartsGoesToTheOneThatHasMostOfIt)
{
  const ElementMesh mesh = slab(40, 32, 8);
  const Classification classes = classified(mesh, { ball({ -3, 0, 5 }, 4.5), ball({ 3, 0, 5 }, 4.5) }, { 0.3, 0.3 });
  EXPECT_GT(classes.matches[0].elements, 50u);
  EXPECT_EQ(classes.matches[0].elements, classes.matches[1].elements);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    const double right = mesh.points(0, mesh.elements[e].nodes[0]) + mesh.points(0, mesh.elements[e].nodes[6]);
    EXPECT_TRUE(classes.part[e] == 0 || classes.part[e] == (right < 0 ? 1 : 2));
  }
}

TEST(PartOverlap, APartBetweenAllSamplesEndsWithoutElements)
{
  ElementMesh sheet = slab(10, 8, 1); // 0.2 mm thick, where samples are 0.83 mm apart
  sheet.points.topRows(2) *= 0.4;
  for (Eigen::Index i = 0; i < sheet.points.cols(); ++i)
    sheet.points(2, i) = 5 + (i < sheet.points.cols() / 2 ? -0.1 : 0.1);
  ElementMesh flat = slab(10, 8, 2);
  for (Eigen::Index i = 0; i < flat.points.cols(); ++i) flat.points(2, i) = 5. * double(i / (flat.points.cols() / 3));
  const Part part{ "sheet", "sheet.vtp", outerSurface(sheet) };
  const Classification classes = classified(flat, { part }, { 0 });
  EXPECT_EQ(classes.matches[0].elements, 0u);
  EXPECT_GT(classes.matches[0].partVolume, 0);
}

TEST(PartOverlap, APartElsewhereIsRefused)
{
  EXPECT_THROW(classified(slab(), { ball({ 0, 0, 100 }, 5) }, { 0 }), InputError);
}
