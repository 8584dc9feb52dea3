// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Archives of blocked commands for Ansys Mechanical APDL (.cdb).

#include "Export.h"

namespace surgicalmesher
{

/// NBLOCK and EBLOCK: tetrahedra are SOLID285, of second order SOLID187, hexahedra and wedges SOLID185, shells SHELL181
/// (three or four nodes) and SHELL281 (six), with a shell section each; the material of an element is that of its section. MP,
/// and TB,HYPER of neo-Hookean materials; CMBLOCK for sets of elements and nodes, D for null-displacement nodes. Names of
/// components have 32 characters at most, longer ones keep head and tail. Curves are left out.
void writeAnsys(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
