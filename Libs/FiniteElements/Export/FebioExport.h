// SPDX-License-Identifier: Apache-2.0
#pragma once
/// FEBio models, file format 4.0 (.feb).

#include "Export.h"

namespace surgicalmesher
{

/// Material, Mesh (one part of tet4 elements per section, one of tri3 per shell, node sets, surfaces, element sets),
/// MeshDomains, and zero displacement of null-displacement nodes.
void writeFebio(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
