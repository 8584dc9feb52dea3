// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The edge lengths requested on the command line of a program of this module.

#include "ScaleField.h"

#include <string>

namespace surgicalmesher
{

/// Returns the scale given by --scale (a file) or --edgeLength (above 0). Throws UsageError unless exactly one of them
/// is given, InputError unless the scale covers the grid.
ScaleField readScaleOption(const std::string& file, double uniform, const Grid& grid);

} // namespace surgicalmesher
