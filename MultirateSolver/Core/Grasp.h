// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A tool that holds a few points of a child.

#include "LinearChild.h"

#include <Eigen/Cholesky>

namespace surgicalmesher
{

/// The points held by a tool: free points of a part, ascending.
using Hold = std::vector<std::int32_t>;

/// Returns the free points of `part` within `radius` (mm) of `tip`, at most the `most` nearest ones. Points are where
/// `displacement` (mm, of all unknowns) has moved them. The nearest point is always held, unless it is farther than
/// `reach`: then the result is empty.
Hold holdNear(const Part& part, const Eigen::VectorXd& displacement, const Vec3& tip, double radius, double reach,
              std::size_t most);

/// Where a displacement (mm, of all unknowns) moves a free point.
Vec3 displacedPoint(const Part& part, const Eigen::VectorXd& displacement, std::int32_t point);

/// Ties each held point to the tool by a spring, which keeps a haptic device stable (virtual coupling: Colgate,
/// Stanley, Brown, IROS 1995). Body and springs are in equilibrium.
class Grasp
{
public:
  /// `stiffness` is that of all springs together, N/mm, above 0.
  Grasp(const LinearChild& child, const Hold& hold, double stiffness);

  /// Returns the force of the tool on each held unknown (N) after a motion (mm) of the tool since the constructor, when
  /// it took hold of the child at rest.
  Eigen::VectorXd forces(const LinearChild& child, const Vec3& motion) const;

  /// Returns the displacements of all unknowns of the child, mm. Called at every step: it must keep up with the tool.
  Eigen::VectorXd displacement(const LinearChild& child, const Eigen::VectorXd& forces) const;

private:
  std::vector<std::int32_t> m_Unknowns;
  Eigen::MatrixXd m_Compliance;                  ///< compliance columns of the held unknowns: (unknowns, held)
  Eigen::VectorXd m_Start;                       ///< displacements of the held unknowns when the tool took hold
  Eigen::LLT<Eigen::MatrixXd> m_SpringsInSeries; ///< 1 / k plus the compliance between held unknowns
};

/// Returns the unknowns of points.
std::vector<std::int32_t> unknownsOf(const ElasticBody& body, const Hold& hold);

/// The sum of forces on points, three components each.
Vec3 totalOf(const Eigen::VectorXd& forces);

} // namespace surgicalmesher
