// SPDX-License-Identifier: Apache-2.0
#include "VolumeRestoring.h"

#include "TissueOffsets.h"

#include <algorithm>

namespace surgicalmesher
{

void restoreVolumesOfBlock(GuardedOperations& operations, const VolumeRestoringOptions& options)
{
  for (int round = 0; round < options.rounds; ++round)
  {
    const TissueOffsets offsets = options.wanted.offsets(operations.complex(), options.leastShare);
    if (std::all_of(offsets.begin(), offsets.end(), [](const auto& offset) { return offset.second == 0; })) return;
    offsetTissuesOfBlock(operations, { offsets, options.goodAngle });
  }
}

} // namespace surgicalmesher
