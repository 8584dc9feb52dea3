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
  /// `goals` has a column per centre. The centres must span space and differ from each other, as requireUsable() of
  /// Landmarks.h makes sure of landmarks; throws EngineError if the system has no solution.
  ThinPlateSpline(const Points& centres, const Points& goals);

  Points operator()(const Points& points) const;

private:
  Points m_Centres;
  Points m_Weights;                     ///< c_i
  Eigen::Matrix<double, 3, 4> m_Affine; ///< of (x - middle, 1)
  Eigen::Vector3d m_Middle;
  double m_Size; ///< unit of length: keeps the system well scaled
};

/// How far each goal lies from where the spline of all other centres takes its centre, in the goals' unit: what a
/// landmark that was mistaken stands out by. By one inverse of the equations (Rippa, Adv. Comput. Math. 11, 1999).
/// Infinity where the other centres don't span space. The centres are as for ThinPlateSpline.
std::vector<double> leftOutErrors(const Points& centres, const Points& goals);

/// `count` columns of `points`, or all: each the farthest from those before it, the first the farthest from the middle.
std::vector<std::int32_t> farthestPoints(const Points& points, int count);

} // namespace surgicalmesher
