// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The units of models for solvers.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// "mm" or "si".
Units unitsNamed(const std::string& name);

/// A model in mm, N, MPa, tonne and s in other units: points, edge lengths, thicknesses, radii and materials.
FiniteElementModel inUnits(FiniteElementModel model, Units units);

/// What files say of frame and units: "LPS; mm, N, MPa, tonne, s".
std::string frameAndUnits(const FiniteElementModel& model);

} // namespace surgicalmesher
