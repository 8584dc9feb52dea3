// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flat tetrahedra are what a Delaunay tetrahedralization leaves where four points of a surface lie in one plane but
/// for rounding, as the quadrangles of a revolved or rotated shape do.

#include "TetMesh.h"

namespace surgicalmesher
{

/// Gives every flat or inverted tetrahedron a volume: an edge of it that has one label all around is split by a new
/// point a little off the plane, where all tetrahedra at the edge become positive. Interfaces between labels stay as
/// they are. `mesh` must be face-to-face and, but for rounding, positively wound. Throws EngineError, with the place,
/// if a tetrahedron has no such edge.
void liftFlatTetrahedra(TetMesh& mesh);

} // namespace surgicalmesher
