// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Archives of blocked commands for Ansys Mechanical APDL (.cdb).

#include "Export.h"

namespace surgicalmesher
{

/// Writes NBLOCK and EBLOCK: tetrahedra are SOLID285 (second order: SOLID187), hexahedra and wedges SOLID185, shells
/// SHELL181 (three or four nodes) and SHELL281 (six) with a shell section each, curves BEAM188 or LINK180 with a
/// section each; the material of an element is that of its section. Also MP, and TB,HYPER for neo-Hookean materials;
/// CMBLOCK for sets of elements and nodes, and D for null-displacement nodes. Names of components have at most 32
/// characters; longer ones keep head and tail.
void writeAnsys(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
