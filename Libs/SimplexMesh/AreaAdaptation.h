// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faces of a simplex mesh brought to a target area: small ones fuse, large ones are divided (Audette et al., section
/// 2.3).

#include "SimplexOperators.h"

namespace surgicalmesher
{

/// A_s(x), mm^2.
using TargetArea = std::function<double(const Vec3&)>;

struct AreaCounts
{
  int t1 = 0, t2 = 0, t7 = 0;
};

/// T1 on faces below (1 - tolerance) of their target, the smallest first, unless the two would be too large as one; T2
/// above (1 + tolerance), the largest first; then T7.
AreaCounts adaptAreas(SimplexOperators& mesh, const TargetArea& target, double tolerance);

/// Of the faces, those whose areas are within the tolerance.
double shareWithinTolerance(const SimplexOperators& mesh, const TargetArea& target, double tolerance);

} // namespace surgicalmesher
