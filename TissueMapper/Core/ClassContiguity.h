// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a class is joined to its training points (Audette et al., section 2.2: contiguity and spatial limit).

#include "TissueClassification.h"

#include <vector>

namespace surgicalmesher
{

/// Voxels of class `number` that a front from its training points reaches through voxels of the class, within its limit.
std::vector<bool> reachedFrom(const Grid& grid, const TissueClass& tissue, const std::vector<int>& classOf, int number);

} // namespace surgicalmesher
