// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A front that runs from some voxels through open ones (Audette et al., section 2.2: contiguity and spatial limit).

#include "Grid.h"

#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// Voxels that a front from `seeds` reaches through open ones, over faces, edges and corners, along ways of at most
/// `limit` mm (0: of any length). Seeds that are not open start none.
std::vector<bool> reachedFrom(const Grid& grid, const std::vector<std::size_t>& seeds, const std::vector<bool>& isOpen,
                              double limit);

} // namespace surgicalmesher
