// SPDX-License-Identifier: Apache-2.0
#pragma once
/// LS-DYNA keyword files (.k).

#include "Export.h"

namespace surgicalmesher
{

/// NODE, ELEMENT_SOLID (tetrahedra of ELFORM 10, of second order 16, wedges 15, hexahedra 1), ELEMENT_SHELL; a PART for
/// each section, of one shape, and each shell; MAT_ELASTIC, for neo-Hookean materials MAT_OGDEN_RUBBER of the exponent 2;
/// SET_SOLID, SET_SEGMENT and SET_NODE_LIST with their names as titles, BOUNDARY_SPC_SET of null-displacement nodes.
/// Triangles of six nodes are four of three. Fixed columns; coordinates have 16 of them, other numbers 10. Neither
/// control cards nor loads; curves are left out.
void writeLsDyna(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
