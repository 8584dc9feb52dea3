// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Nastran bulk data (.bdf).

#include "Export.h"

namespace surgicalmesher
{

/// Writes GRID; CTETRA, CPENTA, CHEXA, CTRIA3, CTRIA6, CQUAD4, CBAR and CROD; PSOLID for each section, whose number is
/// the property of its elements, PSHELL for each shell, PBAR or PROD for each curve; MAT1, for neo-Hookean materials
/// their small-strain limit; SPC1 for null-displacement nodes; a SET1 for each node set. Names are comments. Static
/// analysis (SOL 101) without loads.
void writeNastran(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
