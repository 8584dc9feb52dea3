// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A child whose tissue is neo-Hookean, within surroundings that are linear.

#include "Grasp.h"

namespace surgicalmesher
{

/// What a step of Newton's method has come to.
struct Convergence
{
  int iterations = 0;
  double residual = 0; ///< of the largest force of those that are in balance
};

/// Its displacements are those of the whole mesh with the surroundings linear and the child neo-Hookean, to the
/// tolerance.
class NeoHookeanChild
{
public:
  /// As LinearChild; the norton equivalent is kept.
  NeoHookeanChild(Part part, std::vector<std::int32_t> interface, NortonEquivalent norton, Eigen::VectorXd forces);

  const Part& part() const { return m_Part; }
  const Eigen::VectorXd& displacement() const { return m_Displacement; }

  void setNortonForce(const Eigen::VectorXd& force) { m_Norton.force = force; }

  /// Springs of `stiffness` together (N/mm) draw the held unknowns to displacements `pull` (mm). From the last
  /// displacement, by Newton's method with halved steps, until the residual is under `tolerance` of the largest force.
  /// Throws EngineError if that takes over a hundred iterations.
  Convergence settle(const Hold& hold, const Eigen::VectorXd& pull, double stiffness, double tolerance);
  Convergence settle(double tolerance) { return settle({}, Eigen::VectorXd(), 1, tolerance); }

  /// What the springs do to the held unknowns, N.
  Eigen::VectorXd springForces(const Hold& hold, const Eigen::VectorXd& pull, double stiffness) const;

private:
  struct Springs;
  double energy(const Eigen::VectorXd& displacement, const Springs& springs) const;
  Eigen::VectorXd outerForces(const Eigen::VectorXd& displacement, const Springs& springs) const;
  Eigen::VectorXd newtonStep(const Eigen::VectorXd& residual, const Springs& springs);

  Part m_Part;
  std::vector<std::int32_t> m_Interface;
  NortonEquivalent m_Norton;
  Eigen::VectorXd m_Forces, m_Displacement;
  SparseCholesky m_Factor;
};

} // namespace surgicalmesher
