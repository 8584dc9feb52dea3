// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Curves as people draw and trace them.

#include "CurveNetwork.h"

namespace surgicalmesher
{

/// Every markup of a .mrk.json or .fcsv, through its control points, with the measurement "Radius" of TubePathCLI; or
/// every line of a .vtp or .vtk, with the point array Radius. Names are the file's, numbered where there are several;
/// points without a radius get `missingRadius` (mm). Throws InputError as readMarkups() and readPolylines() do.
std::vector<Curve> readCurves(const std::string& file, double missingRadius);

} // namespace surgicalmesher
