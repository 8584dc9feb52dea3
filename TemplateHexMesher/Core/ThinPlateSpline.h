// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Thin-plate spline of points in space: the smoothest map that takes each centre to its goal.

#include "ElementMesh.h"

namespace surgicalmesher
{

/// x -> A (x, 1) + sum_i c_i |x - centre_i|, the minimiser of the bending energy in three dimensions (Bookstein 1989;
/// Duchon 1977). Solved densely: up to some thousand centres.
class ThinPlateSpline
{
public:
  /// `goals` has a column per centre. The centres must span space and differ from each other, which requireUsable() of
  /// Landmarks.h ensures for landmarks. Throws EngineError if the system has no solution.
  ThinPlateSpline(const Points& centres, const Points& goals);

  /// Maps points, a column each.
  Points operator()(const Points& points) const;

private:
  Points m_Centres;
  Points m_Weights;                     ///< c_i
  Eigen::Matrix<double, 3, 4> m_Affine; ///< acts on (x - middle, 1)
  Eigen::Vector3d m_Middle;
  double m_Size; ///< unit of length: keeps the system well scaled
};

/// Leave-one-out errors: the distance, in the unit of the goals, between each goal and the image of its centre under
/// the spline of all other centres. Large errors reveal misplaced landmarks. Computed from one inverse (Rippa, Adv.
/// Comput. Math. 11, 1999). Infinity where the other centres do not span space. Same preconditions as ThinPlateSpline.
std::vector<double> leftOutErrors(const Points& centres, const Points& goals);

/// Returns the indices of `count` columns of `points`, or of all: first the one farthest from the mean, then each the
/// farthest from those before it.
std::vector<std::int32_t> farthestPoints(const Points& points, int count);

} // namespace surgicalmesher
