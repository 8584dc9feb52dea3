// SPDX-License-Identifier: Apache-2.0
#pragma once
/// T2 where proximity asks for it: more triangles where the interface is too far from its samples.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct ProximityOptions
{
  double leastAngle = 12; ///< degrees, that splits may leave
  double shortest = 0.6;  ///< mm; shorter edges are not split
  int rounds = 2;
};

/// Wherever a sample is beyond its tolerance of its face, the face's vertices go to where their samples are nearest; if
/// that does not mend it, the longest edge of the face is split and the new vertex goes there likewise. A split after
/// which the sample is as far off as before is taken back.
void meetProximityOfBlock(GuardedOperations& operations, const ProximityOptions& options = {});

} // namespace surgicalmesher
