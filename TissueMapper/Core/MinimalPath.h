// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Path of least travel time between two points for a given speed at every voxel: first-order fast marching of |grad T|
/// speed = 1 in millimetres (Sethian, PNAS 93(4), 1996), then steepest descent on T (Cohen and Kimmel, IJCV 24(1),
/// 1997).

#include "Grid.h"

#include <vector>

namespace surgicalmesher
{

/// Returns the arrival time at every voxel of a front from `source`; positions are in the grid frame, mm. The front
/// stops when it reaches `target`; voxels it has not reached by then have infinite time. `speed` (mm per unit of time,
/// by voxel) is at least 0; the front does not enter voxels of speed 0.
std::vector<float> arrivalTimes(const Grid& grid, const std::vector<float>& speed, const Vec3& source,
                                const Vec3& target);

/// Returns the minimal path from `source` to `target`, in steps of a third of a voxel. Throws InputError if no front
/// reaches the target.
std::vector<Vec3> minimalPath(const Grid& grid, const std::vector<float>& speed, const Vec3& source,
                              const Vec3& target);

} // namespace surgicalmesher
