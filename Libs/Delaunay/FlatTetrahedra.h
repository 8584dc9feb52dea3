// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Removal of flat tetrahedra. A Delaunay tetrahedralization leaves them where four points of a surface are coplanar up
/// to rounding, such as the quadrangles of a revolved or rotated shape.

#include "TetMesh.h"

namespace surgicalmesher
{

/// Gives every flat or inverted tetrahedron a positive volume: one of its edges, with one label all around, is split by
/// a new point slightly off the plane, where all tetrahedra at the edge become positive. Interfaces between labels are
/// unchanged. `mesh` must be face-to-face and, up to rounding, positively oriented. Throws EngineError, with the
/// position, if a tetrahedron has no such edge.
void liftFlatTetrahedra(TetMesh& mesh);

} // namespace surgicalmesher
