// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Images of intensities that were taken for label maps.

#include "TissueMap.h"

#include <string>

namespace surgicalmesher
{

/// Why the map looks like an image of intensities: it has dozens of labels, and most neighbouring voxels (across a
/// face, both in tissue) differ, mostly by little, as noise and slopes do. Empty for maps that look like tissues. The
/// sentence goes on from the name of the file.
std::string likenessToIntensities(const TissueMap& map);

} // namespace surgicalmesher
