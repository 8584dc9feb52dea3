// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a child is fastened to, as it feels it: the Norton equivalent of the parent and all other children (Astley,
/// Hayward, Multirate haptic simulation achieved by coupling finite element meshes through Norton equivalents, ICRA 1998).

#include "CoupledParts.h"
#include "SparseCholesky.h"

namespace surgicalmesher
{

/// On the unknowns of the interface.
struct NortonEquivalent
{
  Eigen::MatrixXd stiffness; ///< N/mm: Kbb - Kbp inv(Kpp) Kpb, of the surroundings
  Eigen::VectorXd force;     ///< N: fb - Kbp inv(Kpp) fp
};

/// Linear elastic. Its factor is made once; new loads, or the displacement behind an interface that has moved, take one
/// solution each.
class Surroundings
{
public:
  /// `interface`: unknowns of `part`. Throws InputError if a piece of the part hangs on no held point.
  Surroundings(Part part, std::vector<std::int32_t> interface);

  /// Forces on all unknowns, N.
  void load(const Eigen::VectorXd& forces);

  const Part& part() const { return m_Part; }
  const NortonEquivalent& norton() const { return m_Norton; }

  /// Of all unknowns, mm, where those of the interface are given.
  Eigen::VectorXd displacement(const Eigen::VectorXd& interface) const;

private:
  Part m_Part;
  std::vector<std::int32_t> m_Interface;
  SparseCholesky m_Factor;
  NortonEquivalent m_Norton;
  Eigen::VectorXd m_Forces;
};

} // namespace surgicalmesher
