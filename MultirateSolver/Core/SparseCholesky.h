// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Direct solver for sparse symmetric positive definite systems, by CHOLMOD's supernodal factorisation (Chen, Davis,
/// Hager, Rajamanickam, ACM Transactions on Mathematical Software 35(3), 2008).

#include "Elasticity.h"

#include <memory>

namespace surgicalmesher
{

class SparseCholesky
{
public:
  /// Determines the elimination order for all matrices with this pattern. The unknowns `last` come at the end, in their
  /// given order, so that the last block of the factor is the factor of the matrix condensed onto them.
  explicit SparseCholesky(const SymmetricMatrix& pattern, const std::vector<std::int32_t>& last = {});
  ~SparseCholesky();

  /// Factorises a matrix with the given pattern. Returns false if it is not positive definite. Throws EngineError if
  /// memory does not suffice.
  bool factorize(const SymmetricMatrix& matrix);

  /// Solves for one or several right-hand sides, a column each.
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& rightSides) const;

  /// The matrix condensed onto `last` (its Schur complement).
  Eigen::MatrixXd condensed() const;

  /// Number of entries of the factor; a solution reads each of them twice.
  std::size_t entries() const;

private:
  struct Private;
  std::unique_ptr<Private> d;
};

} // namespace surgicalmesher
