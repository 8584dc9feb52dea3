// SPDX-License-Identifier: Apache-2.0
#pragma once
/// FEBio models, file format 4.0 (.feb).

#include "Export.h"

namespace surgicalmesher
{

/// Material, Mesh (one part per section and one per shell, of tet4, tet10, penta6, hex8, tri3, tri6 and quad4 elements, parts of
/// several shapes being divided; node sets, surfaces, element sets),
/// MeshDomains, and zero displacement of null-displacement nodes.
void writeFebio(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
