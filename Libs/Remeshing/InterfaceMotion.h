// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The interface as a simplex mesh in motion (SimplexDeformation.h), inside the tetrahedra that guard it: as smooth as
/// its samples' tolerances allow, where elements are of the voxels' size and follow every step of the map.

#include "GuardedOperations.h"
#include "SimplexDeformation.h"

namespace surgicalmesher
{

struct InterfaceMotionOptions
{
  MotionOptions motion{ 0.8, 0.3, 0.1, {}, 1.2 };
  double leastAngle =
    15;                  ///< degrees; a move may lower the worst angle at its vertex to this, what improves comes after
  double farthest = 0.3; ///< mm, that a vertex moves at most; nor 0.3 of its target length
  double fineLength = 1; ///< mm; beyond this target length it is farthest * (fineLength / length)^1.5
  int steps = 6;
};

/// Steps of the law of motion on the simplex mesh that is dual to the interface of the block. The image force leads each
/// of its vertices, which are the interface's triangles, along their normal to the mean of their samples. Where more
/// than two tissues meet, the curve between them is a simplex mesh of one dimension less, whose points are besides
/// drawn against the umbrella vectors of their umbrella vectors (Kobbelt et al., SIGGRAPH 1998, equation 9). Then every
/// tissue of the block gets the volume that it had, within the same reach: its boundary is offset by one length.
void moveInterfaceOfBlock(GuardedOperations& operations, const InterfaceMotionOptions& options = {});

} // namespace surgicalmesher
