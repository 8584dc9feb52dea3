// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The surroundings of a child, as the child sees them: the Norton equivalent of the parent and all other children
/// (Astley, Hayward, Multirate haptic simulation achieved by coupling finite element meshes through Norton equivalents,
/// ICRA 1998).

#include "CoupledParts.h"
#include "SparseCholesky.h"

namespace surgicalmesher
{

/// Stiffness and force that replace the surroundings, on the unknowns of the interface.
struct NortonEquivalent
{
  Eigen::MatrixXd stiffness; ///< N/mm: Kbb - Kbp inv(Kpp) Kpb, of the surroundings
  Eigen::VectorXd force;     ///< N: fb - Kbp inv(Kpp) fp
};

/// Linear elastic surroundings. The matrix is factorised once; a new load, or the displacements for an interface that
/// has moved, take one solution each.
class Surroundings
{
public:
  /// `interface`: unknowns of `part`. Throws InputError if a component of the part has neither a held point nor
  /// one of the interface.
  Surroundings(Part part, std::vector<std::int32_t> interface);

  /// Sets the forces on all unknowns, N, and updates the Norton force.
  void load(const Eigen::VectorXd& forces);

  const Part& part() const { return m_Part; }
  const NortonEquivalent& norton() const { return m_Norton; }

  /// Returns the displacements of all unknowns, mm, for given displacements of the interface.
  Eigen::VectorXd displacement(const Eigen::VectorXd& interface) const;

private:
  Part m_Part;
  std::vector<std::int32_t> m_Interface;
  double m_Spring;         ///< N/mm, at each unknown of the interface
  SparseCholesky m_Factor; ///< with the springs
  NortonEquivalent m_Norton;
  Eigen::VectorXd m_Forces;
};

} // namespace surgicalmesher
