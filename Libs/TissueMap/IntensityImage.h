// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Detection of intensity images that were passed as label maps.

#include "TissueMap.h"

#include <string>

namespace surgicalmesher
{

/// Returns why the map looks like an image of intensities: it has dozens of labels, and most neighbouring voxels
/// (across a face, both in tissue) differ, mostly by little, as noise and slopes do. The sentence continues the name of
/// the file. Empty for maps that look like tissues.
std::string likenessToIntensities(const TissueMap& map);

} // namespace surgicalmesher
