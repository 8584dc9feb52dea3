// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conditions on a surface that is to be filled with tetrahedra, and the conversion of foreign surfaces to meet them.

#include "SurfaceRefused.h"

#include <utility>

namespace surgicalmesher
{

/// Returns the pairs of triangles that meet elsewhere than in a common point or edge, found with exact predicates; a
/// duplicate of a triangle forms such a pair with it. Ascending.
std::vector<std::pair<std::int32_t, std::int32_t>> selfIntersections(const SurfaceComplex& surface);

/// Throws SurfaceRefused, with the position in mm, unless the boundary of every tissue is a closed 2-manifold with the
/// tissue on matching sides, no triangle is degenerate, and no triangles meet elsewhere than in a common point or edge.
/// `name` identifies the surface in messages, such as its file.
void requireFillable(const SurfaceComplex& surface, const std::string& name);

/// Merges each point with an earlier one within `tolerance` mm, or in the same grid cell of that width (0: at exactly
/// the same position); points keep the order of their first appearance. Triangles that become degenerate are dropped.
/// Needed for STL files, which repeat each point in every triangle.
SurfaceComplex withoutDuplicatePoints(const SurfaceComplex& surface, double tolerance = 0);

/// Returns label pairs for a surface without any: each closed shell (triangles joined through edges) becomes a tissue,
/// numbered from 1 in the order of their first triangles. Triangles are oriented with their normals out of their shell;
/// the label in front is that of the innermost enclosing shell, or 0. Points closer than a millionth of the diagonal
/// are merged first. Throws SurfaceRefused for open shells, edges with more than two triangles, non-orientable shells
/// and self-intersections; InputError for more than 65535 shells.
SurfaceComplex closedShellsToTissues(const SurfaceComplex& surface, const std::string& name);

} // namespace surgicalmesher
