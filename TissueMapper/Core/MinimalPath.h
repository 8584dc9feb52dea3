// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The path between two points along which the least time passes, for a given speed at every voxel: first-order fast
/// marching of |grad T| speed = 1 in millimetres (Sethian, PNAS 93(4), 1996), then steepest descent on T (Cohen and
/// Kimmel, IJCV 24(1), 1997).

#include "Grid.h"

#include <vector>

namespace surgicalmesher
{

/// Time of arrival of a front from `source`, at every voxel; infinite where it has not come when it reaches `target`
/// (grid frame, mm). `speed` (mm per unit of time) is at least 0 by voxel; no front passes where it is 0.
std::vector<float> arrivalTimes(const Grid& grid, const std::vector<float>& speed, const Vec3& source,
                                const Vec3& target);

/// From `target` down to `source`, given in the other order: source first. Steps of a third of a voxel. Throws
/// InputError if no front reaches the target.
std::vector<Vec3> minimalPath(const Grid& grid, const std::vector<float>& speed, const Vec3& source,
                              const Vec3& target);

} // namespace surgicalmesher
