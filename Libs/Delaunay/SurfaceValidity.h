// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a surface must be before it can be filled with tetrahedra, and how surfaces from elsewhere become so.

#include "SurfaceRefused.h"

#include <utility>

namespace surgicalmesher
{

/// Pairs of triangles that meet elsewhere than in a common point or edge, by exact predicates; duplicates of a triangle
/// count as such a pair. Ascending.
std::vector<std::pair<std::int32_t, std::int32_t>> selfIntersections(const SurfaceComplex& surface);

/// Throws SurfaceRefused, with the place in mm, unless every tissue's boundary is a closed 2-manifold with the tissue
/// on matching sides, no triangle is degenerate and none meets another elsewhere than in a common point or edge. `name`
/// says in messages what the surface is: its file.
void requireFillable(const SurfaceComplex& surface, const std::string& name);

/// Points within `tolerance` mm (0: at the very same place) of an earlier one become that one; points keep the order of
/// their first appearance. Triangles that become degenerate by that are dropped. STL files repeat each point in every
/// triangle.
SurfaceComplex withoutDuplicatePoints(const SurfaceComplex& surface, double tolerance = 0);

/// Label pairs for a surface without any: each closed shell (triangles joined through edges) is a tissue, numbered from
/// 1 in the order of their first triangles. Triangles are turned so that their normals point out of their shell; in
/// front lies the tissue of the innermost shell around it, or 0. Points closer than a millionth of the diagonal are
/// merged first. Throws SurfaceRefused for open shells, for edges with more than two triangles, for shells that can't
/// be oriented and for self-intersections; InputError for more than 65535 shells.
SurfaceComplex closedShellsToTissues(const SurfaceComplex& surface, const std::string& name);

} // namespace surgicalmesher
