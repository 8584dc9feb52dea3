// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Does an ambient complex belong to a surface?

#include "TetMesh.h"

#include <string>

namespace surgicalmesher
{

/// Throws InputError, with both names and the place in mm, unless the label interfaces of `ambient` are exactly the
/// triangles of `surface`: the same positions and the same labels on the same sides.
void requireInterfacesAre(const SurfaceComplex& surface, const std::string& surfaceName, const TetMesh& ambient,
                          const std::string& ambientName);

} // namespace surgicalmesher
