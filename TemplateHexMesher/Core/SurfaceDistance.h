// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Distance from one surface to another.

#include "TargetSurface.h"

namespace surgicalmesher
{

struct DistanceSummary
{
  double mean = 0, percentile95 = 0, maximum = 0; ///< mm
};

/// Samples `from` evenly and summarises the distances to the closest points of `to`, whatever their normals. Samples
/// are the centroids of the triangles of `from`, divided until no edge is longer than `spacing` (mm), weighted by area.
DistanceSummary distanceBetween(const TriangleSurface& from, const TargetSurface& to, double spacing = 1);

} // namespace surgicalmesher
