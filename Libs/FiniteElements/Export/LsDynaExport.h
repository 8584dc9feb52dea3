// SPDX-License-Identifier: Apache-2.0
#pragma once
/// LS-DYNA keyword files (.k).

#include "Export.h"

namespace surgicalmesher
{

/// Writes NODE, ELEMENT_SOLID (tetrahedra with ELFORM 10, second order 16, wedges 15, hexahedra 1), ELEMENT_SHELL and
/// ELEMENT_BEAM; a PART for each section and shape, each shell and each curve; MAT_ELASTIC, and MAT_OGDEN_RUBBER with
/// the exponent 2 for neo-Hookean materials; SET_SOLID, SET_SEGMENT and SET_NODE_LIST with their names as titles, and
/// BOUNDARY_SPC_SET for null-displacement nodes. Six-node triangles are divided into four of three nodes. Fields have
/// fixed columns: coordinates 16, numbers in nodes and elements 8, others 10. No control cards and no loads.
void writeLsDyna(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
