// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ten-node tetrahedra whose faces follow the curvature of tissue boundaries.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Moves the mid-side nodes of edges on a boundary between two tissues (or a tissue and the outside) onto a curved
/// boundary, which is estimated from the normals at the ends of the edge: the midpoint of the cubic of Vlachos et al.
/// (Curved PN triangles, I3D 2001). The normal at an end is the mean over the triangles around it that are within 40
/// degrees of those at the edge, so that flat faces stay flat up to sharp edges. Edges stay straight where several
/// boundaries meet, where the boundary is sharper than that, and where the node would move by more than 0.15 of the
/// edge's length. `model` must be a result of withMidSideNodes().
///
/// The determinant of the Jacobian stays above 0.3 of its value with straight sides throughout every tetrahedron,
/// guaranteed by its Bernstein coefficients: where this fails, the mid-side nodes of the tetrahedron are moved back.
FiniteElementModel withCurvedSides(FiniteElementModel model);

/// Returns the least of these coefficients relative to the determinant with straight sides: a lower bound of the
/// Jacobian.
double leastJacobian(const Cell& tetrahedron, const std::vector<Vec3>& points);

} // namespace surgicalmesher
