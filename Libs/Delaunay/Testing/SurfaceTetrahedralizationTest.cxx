// SPDX-License-Identifier: Apache-2.0
#include "SurfaceTetrahedralization.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "Shapes.h"
#include "SurfaceValidity.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace surgicalmesher
{
namespace
{

struct Shape
{
  std::string name;
  SurfaceComplex surface;
  double edgeLength;
};

SurfaceComplex surfaceOf(const std::array<int, 3>& size, const std::function<int(int, int, int)>& paint)
{
  return interfaceOf(test::tetrahedraOf(test::paintedMap(size, paint)));
}

/// Turned so that no face of a voxel lies in a coordinate plane: its two triangles are coplanar but for rounding.
SurfaceComplex turned(SurfaceComplex surface)
{
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (Vec3& p : surface.points)
  {
    p = { c * p.x - s * p.y, s * p.x + c * p.y, p.z };
    p = { p.x, c * p.y - s * p.z, s * p.y + c * p.z };
  }
  return surface;
}

std::vector<Shape> shapes()
{
  SurfaceComplex nested = test::sphere({}, 8, 3, 1, 0);
  test::append(nested, test::sphere({ 1, 0, 0 }, 4, 2, 2, 1));
  test::append(nested, test::sphere({ -5, 0, 0 }, 1, 1, 0, 1)); // a cavity
  return {
    { "sphere", test::sphere({ 3, 4, 5 }, 10, 3), 2 },
    { "torus", test::torus(8, 3, 32, 12), 1.5 },
    { "nested spheres", nested, 1.5 },
    { "two touching cubes", surfaceOf({ 6, 3, 3 }, [](int i, int, int) { return i < 3 ? 1 : 2; }), 1 },
    { "two cubes touching along an edge",
      surfaceOf({ 4, 4, 2 }, [](int i, int j, int) { return (i < 2) == (j < 2) ? 1 + (i < 2) : 0; }), 1 },
    { "three tissues around a junction",
      surfaceOf({ 6, 6, 4 }, [](int i, int j, int) { return i < 3   ? 1
                                                            : j < 3 ? 2
                                                                    : 3; }), 1 },
    { "thin slab", surfaceOf({ 8, 8, 1 }, [](int, int, int) { return 1; }), 1 },
    { "turned cubes", turned(surfaceOf({ 6, 3, 3 }, [](int i, int, int) { return i < 3 ? 1 : 2; })), 1 },
    { "turned slab, no room for inner points", turned(surfaceOf({ 5, 5, 1 }, [](int, int, int) { return 1; })), 2 },
    { "one voxel", surfaceOf({ 1, 1, 1 }, [](int, int, int) { return 1; }), 1 },
    { "coarse scale", test::sphere({}, 10, 3), 30 },
  };
}

TetMesh filled(const Shape& shape)
{
  const auto length = [&](const Vec3&) { return shape.edgeLength; };
  return fillWithTetrahedra(shape.surface, length, shape.name);
}

using PlacedTriangle = std::pair<std::array<std::int32_t, 3>, std::array<Label, 2>>;

/// Triangles by the surface's point ids, smallest first, with the winding that has the higher label behind.
std::set<PlacedTriangle> triangleSet(const SurfaceComplex& surface, const std::vector<std::int32_t>& ids)
{
  std::set<PlacedTriangle> result;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    std::array<std::int32_t, 3> triangle;
    for (int c = 0; c < 3; ++c) triangle[c] = ids.empty() ? surface.triangles[t][c] : ids[surface.triangles[t][c]];
    std::array<Label, 2> labels = surface.labels[t];
    if (labels[0] < labels[1])
    {
      std::swap(labels[0], labels[1]);
      std::swap(triangle[1], triangle[2]);
    }
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    result.emplace(triangle, labels);
  }
  return result;
}

TEST(Tetrahedralize, IsSoundAndFillsEveryTissue)
{
  for (const Shape& shape : shapes())
  {
    SCOPED_TRACE(shape.name);
    ASSERT_NO_THROW(requireFillable(shape.surface, shape.name));
    const TetMesh ambient = filled(shape);
    EXPECT_NO_THROW(requireSound(ambient, "test"));
    const TetMesh mesh = withoutOutside(ambient);
    EXPECT_NO_THROW(requireSound(mesh, "test"));
    const MeshQuality quality = assessQuality(mesh, {}, {});
    const auto tissues = checkSurface(shape.surface);
    ASSERT_EQ(quality.tissues.size(), tissues.size());
    for (const auto& [label, tissue] : tissues)
    {
      EXPECT_NEAR(quality.tissues.at(label).volume, tissue.volume, 1e-10 * tissue.volume) << label;
    }
  }
}

TEST(Tetrahedralize, InterfacesAreTheInputsTriangles)
{
  for (const Shape& shape : shapes())
  {
    SCOPED_TRACE(shape.name);
    const TetMesh mesh = withoutOutside(filled(shape));
    for (std::size_t i = 0; i < shape.surface.points.size(); ++i)
      ASSERT_TRUE(mesh.points[i] == shape.surface.points[i]);
    std::vector<std::int32_t> ids;
    const SurfaceComplex between = interfaceOf(mesh, &ids);
    EXPECT_EQ(triangleSet(between, ids), triangleSet(shape.surface, {}));
  }
}

TEST(Tetrahedralize, KeepsTheTopologyOfTheMap)
{
  const TissueMap map = test::paintedMap({ 7, 7, 5 },
                                         [](int i, int j, int k)
                                         {
                                           const bool ring = k == 2 && i > 0 && i < 6 && j > 0 && j < 6 &&
                                                             (i < 2 || i > 4 || j < 2 || j > 4);
                                           return ring ? 2 : i == 3 && j == 3 && k == 2 ? 3 : 1;
                                         });
  const Shape shape{ "a ring and a core in a block", interfaceOf(test::tetrahedraOf(map)), 1 };
  const auto expected = tissueTopology(map);
  const auto found = meshTopology(filled(shape));
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [label, betti] : expected) EXPECT_TRUE(found.at(label) == betti) << label;
}

/// Away from the surface the mesh is the canonical tetrahedron's partition itself.
TEST(Tetrahedralize, InnerElementsAreCanonical)
{
  const Shape cube{ "cube", surfaceOf({ 12, 12, 12 }, [](int, int, int) { return 1; }), 1 };
  const TetMesh mesh = withoutOutside(filled(cube));
  const MeshQuality quality = assessQuality(mesh, {}, {});
  const auto mode = [](const Histogram& h)
  { return std::max_element(h.counts.begin(), h.counts.end()) - h.counts.begin(); };
  EXPECT_EQ(mode(quality.valence), 24);
  std::size_t inner = 0, canonical = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
  {
    const std::array<Vec3, 4> p{ mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d] };
    const bool deep = std::all_of(p.begin(), p.end(),
                                  [](const Vec3& q) {
                                    return std::min({ q.x, q.y, q.z }) > 1.6 && std::max({ q.x, q.y, q.z }) < 9.4;
                                  });
    if (!deep) continue;
    ++inner;
    auto angles = dihedralAngles(p[0], p[1], p[2], p[3]);
    std::sort(angles.begin(), angles.end());
    canonical += std::abs(angles[3] - 60) < 1e-6 && std::abs(angles[4] - 90) < 1e-6;
  }
  EXPECT_GT(inner, 1000u);
  EXPECT_EQ(canonical, inner);
}

/// A cone's base is a fan of thin triangles around a point, its side a fan around another: TetGen finds both hard.
TEST(Tetrahedralize, FillsACone)
{
  SurfaceComplex cone;
  const int around = 30;
  for (int i = 0; i < around; ++i)
  {
    const double angle = 2 * std::acos(-1.0) * i / around;
    cone.points.push_back({ 0, 6 * std::cos(angle), 6 * std::sin(angle) });
  }
  cone.points.push_back({ 15, 0, 0 });
  for (int i = 0; i < around; ++i) cone.triangles.push_back({ i, (i + 1) % around, around });
  for (int i = 1; i + 1 < around; ++i) cone.triangles.push_back({ 0, i + 1, i });
  cone.labels.assign(cone.triangles.size(), { 1, 0 });
  ASSERT_NO_THROW(requireFillable(cone, "cone"));
  for (const double length : { 0.7, 1.0, 1.5, 3.0 })
  {
    const TetMesh mesh = fillWithTetrahedra(
      cone, [=](const Vec3&) { return length; }, "cone");
    EXPECT_NO_THROW(requireSound(mesh, "test"));
    EXPECT_EQ(triangleSet(interfaceOf(mesh), {}), triangleSet(cone, {})) << length;
  }
}

TEST(Tetrahedralize, IsDeterministic)
{
  const Shape torus{ "torus", test::torus(8, 3, 32, 12), 1.5 };
  const TetMesh first = filled(torus), second = filled(torus);
  EXPECT_EQ(first.tetrahedra, second.tetrahedra);
  EXPECT_EQ(first.labels, second.labels);
  EXPECT_TRUE(std::equal(first.points.begin(), first.points.end(), second.points.begin(), second.points.end()));
}

TEST(Tetrahedralize, RefusesLabelsThatDisagreeAcrossARegion)
{
  // Each tissue is closed on its own, but the space between the spheres is asked to be both 1 and 3.
  SurfaceComplex surface = test::sphere({}, 8, 2, 1, 0);
  test::append(surface, test::sphere({}, 4, 2, 2, 3));
  ASSERT_NO_THROW(requireFillable(surface, "file.vtp"));
  try
  {
    tetrahedralize(surface, {}, "file.vtp");
    FAIL();
  }
  catch (const SurfaceRefused& refusal)
  {
    const std::string message = refusal.what();
    EXPECT_NE(message.find("file.vtp: BoundaryLabels disagree"), std::string::npos) << message;
    EXPECT_NE(message.find("mm"), std::string::npos) << message;
    EXPECT_FALSE(refusal.offending().triangles.empty());
  }
  EXPECT_THROW(tetrahedralize({}, {}, "file.vtp"), InputError);
}

} // namespace
} // namespace surgicalmesher
