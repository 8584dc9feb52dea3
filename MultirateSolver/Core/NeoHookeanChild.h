// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A child of neo-Hookean tissue within linear surroundings.

#include "Grasp.h"

namespace surgicalmesher
{

/// Outcome of Newton's method.
struct Convergence
{
  int iterations = 0;
  double residual = 0; ///< largest residual force, relative to the largest of the forces in balance
};

/// Computes, to a tolerance, the displacements of the child within the whole mesh, with linear surroundings and a
/// neo-Hookean child.
class NeoHookeanChild
{
public:
  /// Same parameters as LinearChild; keeps a copy of `norton`.
  NeoHookeanChild(Part part, std::vector<std::int32_t> interface, NortonEquivalent norton, Eigen::VectorXd forces);

  const Part& part() const { return m_Part; }
  const Eigen::VectorXd& displacement() const { return m_Displacement; }

  void setNortonForce(const Eigen::VectorXd& force) { m_Norton.force = force; }

  /// Finds equilibrium when springs of total stiffness `stiffness` (N/mm) draw the held unknowns to displacements
  /// `pull` (mm). Starts from the last displacement and uses Newton's method with step halving, until the residual is
  /// at most `tolerance` times the largest force. Throws EngineError after a hundred iterations.
  Convergence settle(const Hold& hold, const Eigen::VectorXd& pull, double stiffness, double tolerance);
  Convergence settle(double tolerance) { return settle({}, Eigen::VectorXd(), 1, tolerance); }

  /// Returns the forces of the springs on the held unknowns, N.
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
