// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The edge lengths that a program of this module is asked for.

#include "ScaleField.h"

#include <string>

namespace surgicalmesher
{

/// What --scale, a file, or --edgeLength, above 0, says. Throws UsageError unless one of them is given, InputError
/// unless the scale covers the grid.
ScaleField readScaleOption(const std::string& file, double uniform, const Grid& grid);

} // namespace surgicalmesher
