// SPDX-License-Identifier: Apache-2.0
#include "CurvedSides.h"

#include "LabelledBlocks.h"
#include "SecondOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace surgicalmesher
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

/// Unit vectors and triangles of an icosahedron whose faces are divided into four.
struct Geodesic
{
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

Geodesic geodesic()
{
  Geodesic sphere;
  std::vector<Vec3>& points = sphere.points;
  const double golden = (1 + std::sqrt(5)) / 2;
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : { -1.0, 1.0 })
      for (const double b : { -golden, golden })
      {
        Vec3 p;
        p[axis] = a;
        p[(axis + 1) % 3] = b;
        points.push_back(p / norm(p));
      }
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b)
  {
    const auto [found, isNew] = middles.try_emplace(std::minmax({ a, b }), std::int32_t(points.size()));
    if (isNew) points.push_back((points[a] + points[b]) / norm(points[a] + points[b]));
    return found->second;
  };
  const auto isEdge = [&](std::int32_t a, std::int32_t b) { return norm(points[a] - points[b]) < 1.1; };
  for (std::int32_t a = 0; a < 12; ++a)
    for (std::int32_t b = a + 1; b < 12; ++b)
      for (std::int32_t c = b + 1; c < 12; ++c)
      {
        if (!isEdge(a, b) || !isEdge(b, c) || !isEdge(a, c)) continue;
        const std::int32_t ab = middle(a, b), bc = middle(b, c), ac = middle(a, c);
        sphere.triangles.insert(sphere.triangles.end(),
                                { { a, ab, ac }, { b, bc, ab }, { c, ac, bc }, { ab, bc, ac } });
      }
  return sphere;
}

/// A ball of the sphere's radius as tetrahedra about its centre, and as tissue 2 a shell about it up to a second radius,
/// of three tetrahedra over each triangle.
MeshFile ball(double radius, double outerRadius = 0)
{
  const Geodesic sphere = geodesic();
  const auto count = static_cast<std::int32_t>(sphere.points.size());
  MeshFile content;
  TetMesh& mesh = content.mesh;
  mesh.points.push_back({});
  for (const Vec3& p : sphere.points) mesh.points.push_back(radius * p);
  if (outerRadius > 0)
    for (const Vec3& p : sphere.points) mesh.points.push_back(outerRadius * p);
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d, Label label)
  {
    if (orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) < 0) std::swap(a, b);
    mesh.tetrahedra.push_back({ a, b, c, d });
    mesh.labels.push_back(label);
  };
  for (std::array<std::int32_t, 3> triangle : sphere.triangles)
  {
    std::sort(triangle.begin(), triangle.end()); // neighbouring prisms are cut alike
    const auto [a, b, c] = std::array{ triangle[0] + 1, triangle[1] + 1, triangle[2] + 1 };
    add(0, a, b, c, 1);
    if (outerRadius == 0) continue;
    add(a, b, c, c + count, 2);
    add(a, b, b + count, c + count, 2);
    add(a, a + count, b + count, c + count, 2);
  }
  return content;
}

/// Faces of six nodes are cut into many flat pieces.
double enclosedVolume(const SurfaceSet& surface, const std::vector<Vec3>& points)
{
  constexpr int kParts = 24;
  double volume = 0;
  for (const Cell& face : surface.cells)
  {
    const auto at = [&](int i, int j)
    {
      const double b = double(i) / kParts, c = double(j) / kParts, a = 1 - b - c;
      return a * (2 * a - 1) * points[face[0]] + b * (2 * b - 1) * points[face[1]] + c * (2 * c - 1) * points[face[2]] +
             4 * (a * b * points[face[3]] + b * c * points[face[4]] + a * c * points[face[5]]);
    };
    for (int i = 0; i < kParts; ++i)
      for (int j = 0; i + j < kParts; ++j)
      {
        volume += dot(at(i, j), cross(at(i + 1, j), at(i, j + 1))) / 6;
        if (i + j + 2 <= kParts) volume += dot(at(i + 1, j), cross(at(i + 1, j + 1), at(i, j + 1))) / 6;
      }
  }
  return volume;
}

const SurfaceSet& outerBoundary(const FiniteElementModel& model)
{
  return *std::find_if(model.surfaces.begin(), model.surfaces.end(),
                       [](const SurfaceSet& set) { return set.kind == SetKind::OuterBoundary; });
}

TEST(CurvedSides, ABallIsRounder)
{
  const FiniteElementModel straight = withMidSideNodes(finiteElementModel(ball(1)));
  const FiniteElementModel curved = withCurvedSides(straight);
  const double whole = 4 * kPi / 3;
  const double before = enclosedVolume(outerBoundary(straight), straight.content.mesh.points);
  const double after = enclosedVolume(outerBoundary(curved), curved.content.mesh.points);
  EXPECT_LT(before / whole, 0.9);
  EXPECT_GT(after / whole, 0.98);
  EXPECT_LT(after / whole, 1);
  for (const Cell& element : curved.elements) EXPECT_GE(leastJacobian(element, curved.content.mesh.points), 0.3);
}

/// Nodes that are elsewhere than with straight sides; they went out along the radius.
int movedNodes(const FiniteElementModel& straight, const FiniteElementModel& curved)
{
  int moved = 0;
  for (std::size_t i = 0; i < straight.content.mesh.points.size(); ++i)
  {
    const Vec3& before = straight.content.mesh.points[i];
    const Vec3& after = curved.content.mesh.points[i];
    if (before == after) continue;
    ++moved;
    EXPECT_NEAR(norm(cross(before, after)), 0, 1e-12);
    EXPECT_GT(norm(after), norm(before));
  }
  return moved;
}

TEST(CurvedSides, BothTissuesFollowTheirBoundary)
{
  const FiniteElementModel straight = withMidSideNodes(finiteElementModel(ball(1, 2)));
  const FiniteElementModel curved = withCurvedSides(straight);
  EXPECT_EQ(movedNodes(straight, curved), 240); // edges of two spheres
}

/// All of a block's boundaries are flat, whatever their tissues and the edges between them.
TEST(CurvedSides, FlatFacesStayFlat)
{
  MeshFile content = test::randomBlocks(4);
  const FiniteElementModel straight = withMidSideNodes(finiteElementModel(content));
  const SurfaceSet& outer = outerBoundary(straight);
  const FiniteElementModel curved = withCurvedSides(straight);
  for (const Cell& face : outer.cells)
  {
    for (const std::int32_t id : face)
      EXPECT_NEAR(norm(curved.content.mesh.points[id] - straight.content.mesh.points[id]), 0, 1e-12);
  }
}

/// A shell thinner than the sphere is curved over an edge: its faces would go through each other.
TEST(CurvedSides, ElementsStaySound)
{
  const FiniteElementModel straight = withMidSideNodes(finiteElementModel(ball(1, 1.02)));
  const FiniteElementModel curved = withCurvedSides(straight);
  EXPECT_LT(movedNodes(straight, curved), 240);
  for (const Cell& element : curved.elements) EXPECT_GE(leastJacobian(element, curved.content.mesh.points), 0.3);
}

TEST(CurvedSides, LeastJacobianIsABound)
{
  FiniteElementModel model = withMidSideNodes(finiteElementModel(ball(1)));
  std::vector<Vec3>& points = model.content.mesh.points;
  const Cell& nodes = model.elements[0];
  EXPECT_NEAR(leastJacobian(nodes, points), 1, 1e-12);
  points[nodes[4]] = points[nodes[0]]; // the middle of an edge at its end: the Jacobian is 0 there, and negative beyond
  EXPECT_LT(leastJacobian(nodes, points), 1e-12);
}

} // namespace
} // namespace surgicalmesher
