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

/// The sides of volume elements that no second element has, in the elements' order; of a mesh without volume elements,
/// its elements.
std::vector<Face> outerFaces(const std::vector<Element>& elements);

/// Each face as triangles, a quadrilateral divided along its shorter diagonal.
std::vector<Triangle> trianglesOf(const std::vector<Face>& faces, const Points& points);

/// Pairs of nodes joined by an edge of an element, each once, ascending, the smaller id first.
std::vector<std::array<std::int32_t, 2>> edgesOf(const std::vector<Element>& elements);

/// The points that triangles use, renumbered in their order.
TriangleSurface compacted(const Points& points, const std::vector<Triangle>& triangles);

/// Signed volume in cubed units of the points, by the tetrahedra over the divided sides; 0 for surface elements.
double volumeOf(const Element& element, const Points& points);

} // namespace surgicalmesher
