// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Medit meshes (.mesh), as FreeFEM reads them. Text.

#include "Export.h"

namespace surgicalmesher
{

/// References: of Vertices, the tag of null-displacement nodes (see SetTags.h) or 0; of Triangles and Quadrilaterals, the
/// tag of their piece; of Tetrahedra, Prisms and Hexahedra, the label of their tissue. FreeFEM reads tetrahedra alone.
void writeMedit(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
