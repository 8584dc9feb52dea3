// SPDX-License-Identifier: Apache-2.0
#include "ElementQuality.h"
#include "Slab.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

Points asColumns(const std::vector<Eigen::Vector3d>& points)
{
  Points columns(3, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) columns.col(Eigen::Index(i)) = points[i];
  return columns;
}

/// The ideal element of each shape.
ElementMesh ideal(ElementShape shape)
{
  const double h = std::sqrt(0.75);
  std::vector<Eigen::Vector3d> points;
  if (shape == ElementShape::Hexahedron)
    points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
  else if (shape == ElementShape::Wedge)
    points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, h, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 0.5, h, 1 } };
  else points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, h, 0 }, { 0.5, h / 3, std::sqrt(2. / 3) } };
  ElementMesh mesh{ asColumns(points), { { shape, { 0, 1, 2, 3, 4, 5, 6, 7 } } } };
  return mesh;
}

} // namespace

TEST(ElementMesh, OuterFacesCloseAndEncloseTheVolume)
{
  const ElementMesh mesh = slab();
  const std::vector<Face> faces = outerFaces(mesh.elements);
  EXPECT_EQ(faces.size(), std::size_t(2 * (10 * 8 + 10 * 2 + 8 * 2)));
  std::map<std::array<std::int32_t, 2>, int> directed;
  double sixfold = 0, volume = 0;
  for (const Triangle& t : trianglesOf(faces, mesh.points))
  {
    for (int i = 0; i < 3; ++i) ++directed[{ t[i], t[(i + 1) % 3] }];
    sixfold += mesh.points.col(t[0]).dot(mesh.points.col(t[1]).cross(mesh.points.col(t[2])));
  }
  for (const auto& [edge, count] : directed)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(directed.count({ edge[1], edge[0] }), 1u);
  }
  for (const Element& element : mesh.elements)
  {
    EXPECT_GT(volumeOf(element, mesh.points), 0);
    volume += volumeOf(element, mesh.points);
  }
  EXPECT_NEAR(sixfold / 6, volume, 0.01 * volume); // quadrilaterals that aren't flat are divided in other ways
}

TEST(ElementMesh, SurfaceElementsAreTheirOwnOuterFaces)
{
  const std::vector<Element> elements{ { ElementShape::Triangle, { 0, 1, 2 } },
                                       { ElementShape::Quad, { 0, 2, 3, 4 } } };
  EXPECT_EQ(outerFaces(elements).size(), 2u);
  EXPECT_EQ(edgesOf(elements).size(), 6u);
}

TEST(ElementQuality, IsBestForIdealElements)
{
  for (const ElementShape shape : { ElementShape::Hexahedron, ElementShape::Wedge, ElementShape::Tetrahedron })
  {
    const ElementMesh mesh = ideal(shape);
    EXPECT_GT(volumeOf(mesh.elements[0], mesh.points), 0);
    for (const Corner& corner : cornersOf(mesh.elements))
      EXPECT_NEAR(scaledJacobian(corner, mesh.points), corner.best, 1e-12);
  }
  EXPECT_NEAR(elementQuality(ideal(ElementShape::Hexahedron))[0].shapeSkew, 1, 1e-12);
}

TEST(ElementQuality, FindsInvertedCornersOfEveryShape)
{
  for (const ElementShape shape : { ElementShape::Hexahedron, ElementShape::Wedge, ElementShape::Tetrahedron })
  {
    ElementMesh mesh = ideal(shape);
    mesh.points.row(2) *= -1;
    EXPECT_LT(volumeOf(mesh.elements[0], mesh.points), 0);
    for (const Corner& corner : cornersOf(mesh.elements))
      EXPECT_NEAR(scaledJacobian(corner, mesh.points), -corner.best, 1e-12);
    EXPECT_EQ(summaryOf(mesh, elementQuality(mesh), shape).invalid, 1u);
  }
  ElementMesh dented = ideal(ElementShape::Hexahedron);
  dented.points.col(6) = Eigen::Vector3d(0.2, 0.2, 0.2); // one corner pushed past the middle
  const ElementQuality quality = elementQuality(dented)[0];
  EXPECT_LT(quality.minimum, 0);
  EXPECT_EQ(quality.shapeSkew, 0);
}

TEST(ElementQuality, DoesNotDependOnPlaceOrSize)
{
  ElementMesh mesh = slab();
  const std::vector<ElementQuality> before = elementQuality(mesh);
  const Eigen::Affine3d motion = Eigen::Translation3d(5, -7, 11) *
                                 Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()) * Eigen::Scaling(0.001);
  mesh.points = motion * mesh.points;
  const std::vector<ElementQuality> after = elementQuality(mesh);
  for (std::size_t e = 0; e < before.size(); ++e)
  {
    EXPECT_NEAR(before[e].minimum, after[e].minimum, 1e-9);
    EXPECT_NEAR(before[e].shapeSkew, after[e].shapeSkew, 1e-9);
  }
}
