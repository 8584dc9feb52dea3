// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A linear elastic child within its surroundings, solved at haptic rate.

#include "Surroundings.h"

namespace surgicalmesher
{

/// Gives exactly the displacements that the child has within the whole mesh:
///
///     | Kbb + S  Kbc | |ub|   |fb + g|
///     | Kcb      Kcc | |uc| = |fc    |
///
/// Any load takes one solution with the factor. Loads on the few points held by a tool use the columns of the inverse,
/// which are computed when the tool takes hold: the product of a tall matrix and a short vector.
class LinearChild
{
public:
  /// `interface`: unknowns of `part`, in the order of `norton`. `forces`: on all unknowns, N, such as the weight.
  /// Throws InputError if the equations are singular.
  LinearChild(Part part, std::vector<std::int32_t> interface, const NortonEquivalent& norton, Eigen::VectorXd forces);

  const Part& part() const { return m_Part; }
  const std::vector<std::int32_t>& interface() const { return m_Interface; }

  /// Sets a new force of the surroundings; takes one solution.
  void setNortonForce(const Eigen::VectorXd& force);

  /// Displacements of all unknowns, mm, without a tool.
  const Eigen::VectorXd& atRest() const { return m_AtRest; }

  /// Returns the displacements (unknowns, k), mm, caused by forces (unknowns, k), N, alone.
  Eigen::MatrixXd response(const Eigen::Ref<const Eigen::MatrixXd>& forces) const { return m_Factor.solve(forces); }

  /// Returns the columns of the inverse for some unknowns, mm/N.
  Eigen::MatrixXd compliance(const std::vector<std::int32_t>& unknowns) const;

  std::size_t factorEntries() const { return m_Factor.entries(); }

private:
  Part m_Part;
  std::vector<std::int32_t> m_Interface;
  SparseCholesky m_Factor;
  Eigen::VectorXd m_Forces, m_AtRest;
};

/// Adds a symmetric matrix `dense` to the rows and columns `at` of `matrix`. All entries of the block are stored.
SymmetricMatrix withDenseBlock(const SymmetricMatrix& matrix, const Eigen::MatrixXd& dense,
                               const std::vector<std::int32_t>& at);

} // namespace surgicalmesher
