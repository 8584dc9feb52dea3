// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Shape quality of hexahedra, wedges and tetrahedra, computed at their corners.
///
/// At a corner, the columns of the Jacobian are the three edges that leave it. The scaled Jacobian is the determinant
/// after scaling the columns to unit length: 1 at a corner of a brick, at most 0.866 at a corner of a wedge over an
/// equilateral triangle, 0.707 in a regular tetrahedron, and at most 0 where the element is inverted. Knupp, "Algebraic
/// mesh quality metrics", SIAM J. Sci. Comput. 23(1), 2001.

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

/// Returns the corners of all volume elements, in the order of the elements: eight of a hexahedron, six of a wedge,
/// four of a tetrahedron.
std::vector<Corner> cornersOf(const std::vector<Element>& elements);

/// Scaled Jacobian at a corner; 0 if an edge has no length.
double scaledJacobian(const Corner& corner, const Points& points);

struct ElementQuality
{
  double minimum = 1; ///< least scaled Jacobian over the corners
  double mean = 1;    ///< mean scaled Jacobian over the corners: the paper's SJ
  /// 3 * corners / sum of |Q| |Q^-1| over the corners, with Q the Jacobian with unit columns and Frobenius norms; 0 if
  /// a scaled Jacobian is not positive.
  double shapeSkew = 1;
};

/// Returns the quality of each element; surface elements get 1. The shape skew follows Knupp, "Algebraic mesh quality
/// metrics for unstructured initial meshes", Finite Elem. Anal. Des. 39, 2003, as used in the paper's SS: 1 for a
/// brick.
std::vector<ElementQuality> elementQuality(const ElementMesh& mesh);

struct QualitySummary
{
  std::size_t elements = 0;
  std::size_t invalid = 0; ///< elements with a corner whose scaled Jacobian is not positive
  double minimum = 1;
  double mean = 1; ///< mean over the elements of ElementQuality::mean
  double meanShapeSkew = 1;
  std::array<std::size_t, 20> histogram{}; ///< of ElementQuality::minimum, in equal bins over [-1, 1], ends included
};

/// Summarises the elements of one shape.
QualitySummary summaryOf(const ElementMesh& mesh, const std::vector<ElementQuality>& quality, ElementShape shape);

} // namespace surgicalmesher
