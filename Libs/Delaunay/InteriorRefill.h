// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The lattice inside tissues that have been tetrahedralized otherwise.

#include "SizingFunction.h"
#include "TetMesh.h"
#include "VertexPlacement.h"

#include <string>

namespace surgicalmesher
{

/// `ambient` with the inside of every tissue that has room for it laid anew: the lattice points of `edgeLength` (see
/// latticePoints), adjusted as `placement` says, by constrained Delaunay between the tissue's own boundary triangles. A tissue has room if a fair
/// share of its tetrahedra touches its boundary with no vertex: it is then deeper than about one of its edges, and these
/// are about as long as L asks for. All others, the space outside and every triangle between labels stay exactly as they
/// are. The new tetrahedra are Delaunay's, slivers included. Where TetGen fails, the result is `ambient`. `ambient` must
/// be positively wound, face-to-face, with label 0 at its hull; so is the result, every point used. The lattice has the
/// axes of the mesh's frame. Deterministic, whatever the number of threads.
TetMesh withLatticeInside(const TetMesh& ambient, const SizingFunction& edgeLength, const std::string& name,
                          VertexPlacement placement = VertexPlacement::Lattice);

} // namespace surgicalmesher
