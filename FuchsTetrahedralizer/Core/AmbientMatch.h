// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Do background tetrahedra belong to a surface?

#include "TetMesh.h"

namespace surgicalmesher
{

/// Whether the triangles of `surface` are exactly the label interfaces of `background`: the same positions and the same
/// labels on the same sides, in any order. A surface without labels is none's.
bool isInterfaceOf(const SurfaceComplex& surface, const TetMesh& background);

} // namespace surgicalmesher
