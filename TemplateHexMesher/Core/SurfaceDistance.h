// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far one surface lies from another.

#include "TargetSurface.h"

namespace surgicalmesher
{

struct DistanceSummary
{
  double mean = 0, percentile95 = 0, maximum = 0; ///< mm
};

/// Evenly spread over `from`: the centres of its triangles divided until no edge is longer than `spacing` (mm), each
/// with its share of the area. Distances to the closest point of `to`, whatever its normal.
DistanceSummary distanceBetween(const TriangleSurface& from, const TargetSurface& to, double spacing = 1);

} // namespace surgicalmesher
