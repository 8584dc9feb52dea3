// SPDX-License-Identifier: Apache-2.0
#pragma once
/// FEBio models, file format 4.0 (.feb).

#include "Export.h"

namespace surgicalmesher
{

/// Writes Material; Mesh, with one part per section and shape, per shell and per curve, of tet4, tet10, penta6, hex8,
/// tri3, tri6, quad4 and line2 elements, and with node sets, surfaces and element sets; MeshDomains; and zero
/// displacement of null-displacement nodes.
void writeFebio(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
