// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Gives tissues back the volumes that other passes have cost them, by offsets of their boundaries.

#include "GuardedOperations.h"
#include "TetQuality.h"
#include "VolumeBalance.h"

namespace surgicalmesher
{

struct VolumeRestoringOptions
{
  VolumeBalance wanted;
  double leastShare = 0.0005;    ///< of its volume from which on a tissue is given it back
  int rounds = 3;                ///< where repairs have cost 1.4 % on jhu189, one leaves 0.35
  double goodAngle = usualAngle; ///< degrees; the worst angle at a vertex may fall to this
};

/// For the whole mesh in one block, as volumes are.
void restoreVolumesOfBlock(GuardedOperations& operations, const VolumeRestoringOptions& options);

} // namespace surgicalmesher
