// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A linear elastic child within its surroundings, at haptic rate.

#include "Surroundings.h"

namespace surgicalmesher
{

/// Holds exactly the displacements that the child has within the whole mesh:
///
///     | Kbb + S  Kbc | |ub|   |fb + g|
///     | Kcb      Kcc | |uc| = |fc    |
///
/// Any load takes one solution with the factor. Loads on the few points that a tool has hold of go by their columns of
/// the inverse, found when it takes hold: a product of a tall matrix and a short vector.
class LinearChild
{
public:
  /// `interface`: unknowns of `part`, in the order of `norton`. `forces`: on all unknowns, N, such as the weight.
  LinearChild(Part part, std::vector<std::int32_t> interface, const NortonEquivalent& norton, Eigen::VectorXd forces);

  const Part& part() const { return m_Part; }
  const std::vector<std::int32_t>& interface() const { return m_Interface; }

  /// The surroundings' force has changed: one solution.
  void setNortonForce(const Eigen::VectorXd& force);

  /// Displacements of all unknowns, mm, without a tool.
  const Eigen::VectorXd& atRest() const { return m_AtRest; }

  /// Displacements by forces alone: (unknowns, k), mm, of (unknowns, k), N.
  Eigen::MatrixXd response(const Eigen::Ref<const Eigen::MatrixXd>& forces) const { return m_Factor.solve(forces); }

  /// Columns of the inverse, mm/N.
  Eigen::MatrixXd compliance(const std::vector<std::int32_t>& unknowns) const;

  std::size_t factorEntries() const { return m_Factor.entries(); }

private:
  Part m_Part;
  std::vector<std::int32_t> m_Interface;
  SparseCholesky m_Factor;
  Eigen::VectorXd m_Forces, m_AtRest;
};

/// `matrix` with `dense` (symmetric) added on the rows and columns `at`, all of whose entries it then has.
SymmetricMatrix withDenseBlock(const SymmetricMatrix& matrix, const Eigen::MatrixXd& dense,
                               const std::vector<std::int32_t>& at);

} // namespace surgicalmesher
