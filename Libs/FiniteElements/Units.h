// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Units of models for solvers.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Returns the units named "mm" or "si".
Units unitsNamed(const std::string& name);

/// Converts a model in mm, N, MPa, tonne and s to other units: points, edge lengths, thicknesses, radii and materials.
FiniteElementModel inUnits(FiniteElementModel model, Units units);

/// Returns the description of frame and units for files, e.g. "LPS; mm, N, MPa, tonne, s".
std::string frameAndUnits(const FiniteElementModel& model);

} // namespace surgicalmesher
