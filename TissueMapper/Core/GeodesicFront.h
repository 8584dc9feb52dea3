// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Front propagation through a mask (Audette et al., section 2.2: contiguity and spatial limit).

#include "Grid.h"

#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// Returns the open voxels that a front from `seeds` reaches across faces, edges and corners along paths of at most
/// `limit` mm (0: no limit). Seeds that are not open are ignored.
std::vector<bool> reachedFrom(const Grid& grid, const std::vector<std::size_t>& seeds, const std::vector<bool>& isOpen,
                              double limit);

} // namespace surgicalmesher
