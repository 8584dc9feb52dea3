// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Nastran bulk data (.bdf).

#include "Export.h"

namespace surgicalmesher
{

/// GRID, CTETRA, CPENTA, CHEXA, CTRIA3, CTRIA6 and CQUAD4; PSOLID for each section, whose number is the elements'
/// property, PSHELL for each shell; MAT1, for neo-Hookean materials their small-strain limit; SPC1 of null-displacement nodes;
/// a SET1 for each node set. Names are comments. Static analysis (SOL 101) without loads; curves are left out.
void writeNastran(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
