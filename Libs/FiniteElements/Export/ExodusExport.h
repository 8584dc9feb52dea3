// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Exodus II (.exo).

#include "Export.h"

namespace surgicalmesher
{

/// Writes a block for each section and shape, each shell and each curve, the latter two with the attribute thickness or
/// radius, and sets of elements, sides and nodes, all with their names. Elements are ordered by block; the element map
/// holds their numbers in the mesh. The format has no materials and boundary conditions. The files are classic netCDF
/// with 64-bit offsets.
void writeExodus(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
