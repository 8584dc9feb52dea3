// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A tool that has hold of a few points of a child.

#include "LinearChild.h"

#include <Eigen/Cholesky>

namespace surgicalmesher
{

/// Where a tool takes hold: points of a part that are free, ascending.
using Hold = std::vector<std::int32_t>;

/// The free points of `part` within `radius` (mm) of `tip`, or the nearest one if there are none; at most `most`, the
/// nearest ones. Empty if the nearest one is farther than `reach`.
Hold holdNear(const Part& part, const Vec3& tip, double radius, double reach, std::size_t most);

/// Each held point is tied to the tool by a spring, which is what keeps a haptic device stable (virtual coupling: Colgate,
/// Stanley, Brown, IROS 1995). The forces are those at which body and springs are in equilibrium.
class Grasp
{
public:
  /// `stiffness`: of all springs together, N/mm, over 0.
  Grasp(const LinearChild& child, const Hold& hold, double stiffness);

  /// What the tool does to each held unknown, N, once it has moved by `motion` (mm) since it took hold of the child at
  /// rest.
  Eigen::VectorXd forces(const LinearChild& child, const Vec3& motion) const;

  /// Displacements of all of the child's unknowns, mm: the step that has to keep up with the tool.
  Eigen::VectorXd displacement(const LinearChild& child, const Eigen::VectorXd& forces) const;

private:
  std::vector<std::int32_t> m_Unknowns;
  Eigen::MatrixXd m_Compliance;                  ///< of the held unknowns: (unknowns, held)
  Eigen::VectorXd m_Start;                       ///< their displacements when the tool took hold
  Eigen::LLT<Eigen::MatrixXd> m_SpringsInSeries; ///< 1 / k + compliance of the held unknowns on each other
};

/// The unknowns of points.
std::vector<std::int32_t> unknownsOf(const ElasticBody& body, const Hold& hold);

/// The sum of forces on points, three components each.
Vec3 totalOf(const Eigen::VectorXd& forces);

} // namespace surgicalmesher
