// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Adaptation of the faces of a simplex mesh to a target area: small faces are fused, large ones are divided (Audette
/// et al., section 2.3).

#include "SimplexOperators.h"

namespace surgicalmesher
{

/// Target area A_s(x) of a face, mm^2; x in the frame of the mesh.
using TargetArea = std::function<double(const Vec3&)>;

struct AreaCounts
{
  int t1 = 0, t2 = 0, t7 = 0;
};

/// Runs one pass of each operator. T1 fuses faces smaller than (1 - tolerance) times their target area, the smallest
/// first, unless the fused face would exceed (1 + tolerance) times the target. T2 cuts faces larger than (1 +
/// tolerance) times their target, the largest first. T7 then swaps edges (swapEdges). Returns the number of operations.
AreaCounts adaptAreas(SimplexOperators& mesh, const TargetArea& target, double tolerance);

/// Returns the fraction of the faces whose area differs from the target by no more than `tolerance`, relative to the
/// target.
double shareWithinTolerance(const SimplexOperators& mesh, const TargetArea& target, double tolerance);

} // namespace surgicalmesher
