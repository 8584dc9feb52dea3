// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Exodus II (.exo).

#include "Export.h"

namespace surgicalmesher
{

/// A block for each section, of one shape, each shell and each curve, with the attribute thickness or radius (mm); sets
/// of elements, sides and nodes, all with their names. Blocks come one after another, so that elements have another order
/// than in the mesh, whose numbers are in the element map. The format has no place for materials and boundary
/// conditions. Classic netCDF files with offsets of 64 bits.
void writeExodus(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
