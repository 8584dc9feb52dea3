// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Test whether background tetrahedra belong to a surface.

#include "TetMesh.h"

namespace surgicalmesher
{

/// Returns whether the triangles of `surface` are exactly the label interfaces of `background`: the same positions, and
/// the same labels on the same sides, in any order. False for a surface without labels.
bool isInterfaceOf(const SurfaceComplex& surface, const TetMesh& background);

} // namespace surgicalmesher
