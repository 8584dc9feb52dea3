// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A bound on how fast edge lengths change.

#include "ScaleField.h"

namespace surgicalmesher
{

/// Lowers L to the largest function below it that rises by no more than `slope` per mm between any two voxel centres:
/// L'(x) = min over all voxels y of L(y) + slope |x - y|. Exact; slope > 0. Infinite lengths are allowed.
void limitGradation(ScaleField& scale, double slope);

} // namespace surgicalmesher
