// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Medit meshes (.mesh), as FreeFEM reads them. Text.

#include "Export.h"

namespace surgicalmesher
{

/// References: of Vertices, the tag of null-displacement nodes (see SetTags.h) or 0; of Triangles, the tag of their
/// piece; of Tetrahedra, the label of their tissue.
void writeMedit(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
