// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Smooths the interface by the motion of its dual simplex mesh (SimplexDeformation.h) inside the guarded tetrahedra,
/// as far as the tolerances of its samples allow. For interfaces whose elements are of the size of the voxels and would
/// otherwise follow every step of the map.

#include "GuardedOperations.h"
#include "SimplexDeformation.h"

namespace surgicalmesher
{

struct InterfaceMotionOptions
{
  MotionOptions motion{ 0.8, 0.3, 0.1, {}, 1.2 };
  /// Degrees; a move may lower the worst dihedral angle at its vertex to this. A later pass improves it again.
  double leastAngle = 15;
  /// mm; largest displacement of a vertex, which is also limited to 0.3 of the target length there.
  double farthest = 0.3;
  double fineLength = 1; ///< mm; at a larger target length L, the limit is farthest * (fineLength / L)^1.5
  int steps = 6;         ///< of the law of motion
};

/// Applies the law of motion to the simplex mesh that is dual to the interface of the block. The image force draws each
/// vertex of the simplex mesh, which is an interface triangle, along the triangle's normal to the mean of its samples.
/// A curve where three or more labels meet is a simplex mesh of one dimension less: a second-order umbrella force,
/// -U(U(p)), smooths its points as well (Kobbelt et al., SIGGRAPH 1998, equation 9). Afterwards the boundary of each
/// tissue is offset by one distance per tissue, within the same displacement limit, to restore the tissue's volume in
/// the block.
void moveInterfaceOfBlock(GuardedOperations& operations, const InterfaceMotionOptions& options = {});

} // namespace surgicalmesher
