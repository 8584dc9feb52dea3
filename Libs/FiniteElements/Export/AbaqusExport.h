// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Abaqus and CalculiX input decks (.inp).

#include "Export.h"

namespace surgicalmesher
{

/// Writes nodes; C3D4, C3D6, C3D8, C3D10, S3, S4, S6, B31 and T3D2 elements; ELSET, NSET, SURFACE, MATERIAL and
/// sections. Null-displacement nodes are clamped. The model has no steps: decks *INCLUDE it before their first *STEP.
void writeAbaqus(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
