// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Shape quality of hexahedra, wedges and tetrahedra by their corners.
///
/// At a corner, the Jacobian's columns are the three edges that leave it. The scaled Jacobian is its determinant with
/// columns of unit length: 1 at a corner of a brick, at most 0.866 at one of a wedge over an equilateral triangle,
/// 0.707 in a regular tetrahedron, and not above 0 where the element is turned inside out. Knupp, "Algebraic mesh
/// quality metrics", SIAM J. Sci. Comput. 23(1), 2001.

#include "ElementMesh.h"

namespace surgicalmesher
{

/// A corner and the nodes at the ends of its edges, which form a right-handed system in a valid element.
struct Corner
{
  std::int32_t node, first, second, third;
  std::int32_t element;
  double best; ///< scaled Jacobian of the ideal element: 1, sqrt(3)/2 or sqrt(2)/2
};

/// Of all volume elements, in their order. A wedge has six, and a tetrahedron four.
std::vector<Corner> cornersOf(const std::vector<Element>& elements);

/// 0 if an edge has no length.
double scaledJacobian(const Corner& corner, const Points& points);

struct ElementQuality
{
  double minimum = 1;   ///< scaled Jacobian over the corners
  double mean = 1;      ///< scaled Jacobian over the corners: the paper's SJ
  double shapeSkew = 1; ///< 3 corners / sum of |Q| |1/Q|, Q the Jacobian with unit columns; 0 if one is not positive
};

/// One per element, in their order; surface elements keep 1. Shape skew after Knupp, "Algebraic mesh quality metrics
/// for unstructured initial meshes", Finite Elem. Anal. Des. 39, 2003, as the paper's SS uses it: 1 for a brick.
std::vector<ElementQuality> elementQuality(const ElementMesh& mesh);

struct QualitySummary
{
  std::size_t elements = 0;
  std::size_t invalid = 0; ///< with a corner whose scaled Jacobian is not positive
  double minimum = 1;
  double mean = 1; ///< over elements of their mean over corners
  double meanShapeSkew = 1;
  std::array<std::size_t, 20> histogram{}; ///< of the minimum over corners in [-1, 1], ends included
};

/// Of the elements of one shape.
QualitySummary summaryOf(const ElementMesh& mesh, const std::vector<ElementQuality>& quality, ElementShape shape);

} // namespace surgicalmesher
