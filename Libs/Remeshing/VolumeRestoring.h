// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Restores the volumes of tissues that other passes have changed, by offsets of their boundaries.

#include "GuardedOperations.h"
#include "TetQuality.h"
#include "VolumeBalance.h"

namespace surgicalmesher
{

struct VolumeRestoringOptions
{
  VolumeBalance wanted;          ///< the volumes to restore
  double leastShare = 0.0005;    ///< a tissue's volume is restored if its error is at least this share of it
  int rounds = 3;                ///< where repairs have cost 1.4 % on jhu189, one round leaves 0.35 %
  double goodAngle = usualAngle; ///< degrees; the worst angle at a vertex may fall to this
};

/// Offsets the tissues' boundaries, round by round. The block must be the whole mesh, as the volumes refer to it.
void restoreVolumesOfBlock(GuardedOperations& operations, const VolumeRestoringOptions& options);

} // namespace surgicalmesher
