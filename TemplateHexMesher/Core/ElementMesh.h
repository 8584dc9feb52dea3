// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Meshes of mixed finite elements, and their outer surface.

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace surgicalmesher
{

using Points = Eigen::Matrix3Xd; ///< one column per point, mm unless a docstring says otherwise

enum class ElementShape : std::uint8_t
{
  Triangle,
  Quad,
  Tetrahedron,
  Wedge,
  Hexahedron
};

/// Nodes are numbered as in Abaqus and Ansys: base counter-clockwise seen from the opposite side, then the opposite
/// side in the same order. (VTK numbers a wedge's triangles the other way round.)
struct Element
{
  ElementShape shape = ElementShape::Hexahedron;
  std::array<std::int32_t, 8> nodes{};
};

struct ElementMesh
{
  Points points;
  std::vector<Element> elements;
};

using Triangle = std::array<std::int32_t, 3>;

struct TriangleSurface
{
  Points points;
  std::vector<Triangle> triangles;
};

/// A side of a volume element, or a surface element, by its nodes, counter-clockwise seen from outside.
struct Face
{
  std::array<std::int32_t, 4> nodes{};
  int size = 4; ///< 3 or 4
};

int nodeCount(ElementShape shape);
bool isVolume(ElementShape shape);
inline bool isVolume(const Element& element) { return isVolume(element.shape); }

/// Returns the sides that belong to a single volume element, in the order of the elements. For a mesh without volume
/// elements, returns its elements.
std::vector<Face> outerFaces(const std::vector<Element>& elements);

/// Splits each face into triangles, a quadrilateral along its shorter diagonal.
std::vector<Triangle> trianglesOf(const std::vector<Face>& faces, const Points& points);

/// Returns the pairs of nodes joined by an edge of an element, each pair once, the smaller id first, sorted.
std::vector<std::array<std::int32_t, 2>> edgesOf(const std::vector<Element>& elements);

/// Returns the triangles with only the points that they use, renumbered in order.
TriangleSurface compacted(const Points& points, const std::vector<Triangle>& triangles);

/// Signed volume, in cubed units of the points; 0 for surface elements. Quadrilateral sides are split along the
/// diagonal from their first node.
double volumeOf(const Element& element, const Points& points);

} // namespace surgicalmesher
