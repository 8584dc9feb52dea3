// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The lattice inside tissues that have been tetrahedralized otherwise.

#include "SizingFunction.h"
#include "TetMesh.h"
#include "VertexPlacement.h"

#include <set>
#include <string>

namespace surgicalmesher
{

/// Tissues that are deeper than about one of their edges, as a fair share of their tetrahedra touches no boundary, with
/// edges about as long as L, `edgeLength`, asks for. Not the space outside.
std::set<Label> tissuesWithRoom(const TetMesh& ambient, const SizingFunction& edgeLength);

/// `ambient` with the inside of each of `tissues` laid anew: the lattice points of `edgeLength` (see latticePoints),
/// adjusted as `placement` says, by constrained Delaunay between the tissue's own boundary triangles. All others, the
/// space outside and every triangle between labels stay exactly as they are. The new tetrahedra are Delaunay's, slivers
/// included. Where TetGen fails, the result is `ambient`. `ambient` must be positively wound, face-to-face, with label 0
/// at its hull; so is the result, every point used. The lattice has the axes of the mesh's frame. Deterministic, whatever
/// the number of threads.
TetMesh withLatticeInside(const TetMesh& ambient, const std::set<Label>& tissues, const SizingFunction& edgeLength,
                          const std::string& name, VertexPlacement placement = VertexPlacement::Lattice);

} // namespace surgicalmesher
