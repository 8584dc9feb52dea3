// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Abaqus and CalculiX input decks (.inp).

#include "Export.h"

namespace surgicalmesher
{

/// Nodes, C3D4, C3D6, C3D8, C3D10, S3, S4 and S6 elements, ELSET, NSET, SURFACE, MATERIAL, SOLID SECTION and SHELL SECTION; null-displacement
/// nodes are clamped. A model without steps: decks *INCLUDE it before their first *STEP.
void writeAbaqus(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
