// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reading and writing of tubes as markups files.

#include "TubePath.h"

#include <string>

namespace surgicalmesher
{

/// Writes a Curve in LPS with the measurements "Radius" (mm) and "Flux" by control point, as Slicer's markups store
/// them. Throws InputError if the file cannot be written in full.
void writeTubePath(const TubePath& tube, const std::string& name, const std::string& file);

/// Reads every markup of a file as a tube. Tubes without the measurement "Radius" get the radius `missingRadius` (mm).
/// Throws InputError as readMarkups() does.
std::vector<TubePath> readTubePaths(const std::string& file, double missingRadius);

} // namespace surgicalmesher
