// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tubes as markups files.

#include "TubePath.h"

#include <string>

namespace surgicalmesher
{

/// A Curve in LPS with the measurements "Radius" (mm) and "Flux" by control point, as Slicer's markups keep them.
/// Throws InputError if the file can't be written whole.
void writeTubePath(const TubePath& tube, const std::string& name, const std::string& file);

/// Every markup of a file as a tube. Those without the measurement "Radius" get `missingRadius` (mm). Throws InputError
/// as readMarkups() does.
std::vector<TubePath> readTubePaths(const std::string& file, double missingRadius);

} // namespace surgicalmesher
