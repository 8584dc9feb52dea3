// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Lattice interiors for tissues that have been tetrahedralized by other means.

#include "SizingFunction.h"
#include "TetMesh.h"
#include "VertexPlacement.h"

#include <set>
#include <string>

namespace surgicalmesher
{

/// Returns the tissues that are deeper than about one of their edges, so that a fair share of their tetrahedra touches
/// no boundary, and whose edges are about as long as L, given by `edgeLength`. The space outside is never included.
std::set<Label> tissuesWithRoom(const TetMesh& ambient, const SizingFunction& edgeLength);

/// Returns `ambient` with the interior of each of `tissues` remeshed by constrained Delaunay tetrahedralization between
/// the boundary triangles of the tissue, with the lattice points of `edgeLength` (see latticePoints), adjusted
/// according to `placement`. All other tissues, the space outside and every triangle between labels remain exactly as
/// they are. The new tetrahedra have Delaunay quality, slivers included. Returns `ambient` unchanged if TetGen fails.
/// `ambient` must be positively oriented and face-to-face, with label 0 at its hull; so is the result, which has no
/// unused points. The lattice has the axes of the mesh's frame. The result does not depend on the number of threads.
TetMesh withLatticeInside(const TetMesh& ambient, const std::set<Label>& tissues, const SizingFunction& edgeLength,
                          const std::string& name, VertexPlacement placement = VertexPlacement::Lattice);

} // namespace surgicalmesher
