// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tetrahedra of ten nodes whose faces follow the curvature of tissue boundaries.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Moves the middle nodes of edges on a boundary between two tissues (or a tissue and outside) to where the boundary is
/// if it bends as the normals at the edge's ends tell: the cubic of Vlachos et al. (Curved PN triangles, I3D 2001),
/// halfway. Normals are the mean of the triangles about an end that are within 40 degrees of those at the edge, so that
/// flat faces stay flat up to sharp edges. Edges where several boundaries meet or one is sharper than that stay
/// straight, as do those that would go out by more than 0.15 of their length. `model` is of withMidSideNodes().
///
/// The determinant of the Jacobian stays above 0.3 of what it is with straight sides throughout every tetrahedron, by its
/// coefficients in Bernstein's basis: where it does not, the tetrahedron's middle nodes go back.
FiniteElementModel withCurvedSides(FiniteElementModel model);

/// The least of those coefficients, over the determinant with straight sides: a bound from below.
double leastJacobian(const Cell& tetrahedron, const std::vector<Vec3>& points);

} // namespace surgicalmesher
