// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Medit meshes (.mesh), as FreeFEM reads them. Text.

#include "Export.h"

namespace surgicalmesher
{

/// References are the tag of null-displacement nodes (see SetTags.h) or 0 for Vertices, the tag of the curve for Edges,
/// the tag of the piece for Triangles and Quadrilaterals, and the label of the tissue for Tetrahedra, Prisms and
/// Hexahedra. Of these volume elements, FreeFEM reads only tetrahedra.
void writeMedit(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
