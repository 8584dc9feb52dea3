// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Input of curves, as drawn or traced by users.

#include "CurveNetwork.h"

namespace surgicalmesher
{

/// Reads every markup of a .mrk.json or .fcsv file as a curve through its control points, with the measurement "Radius"
/// of TubePathCLI, or every line of a .vtp or .vtk file, with the point array Radius. Curves are named after the file,
/// and numbered if there are several. Points without a positive radius get `missingRadius` (mm). Throws InputError as
/// readMarkups() and readPolylines() do.
std::vector<Curve> readCurves(const std::string& file, double missingRadius);

} // namespace surgicalmesher
