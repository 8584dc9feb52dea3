// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Direct solution of sparse symmetric positive definite equations, by CHOLMOD's supernodal factor (Chen, Davis, Hager,
/// Rajamanickam, ACM Transactions on Mathematical Software 35(3), 2008).

#include "Elasticity.h"

#include <memory>

namespace surgicalmesher
{

class SparseCholesky
{
public:
  /// Orders the unknowns of all matrices with this pattern, those of `last` at the end and in their order: then the end
  /// of the factor is that of the matrix condensed onto them.
  explicit SparseCholesky(const SymmetricMatrix& pattern, const std::vector<std::int32_t>& last = {});
  ~SparseCholesky();

  /// Of a matrix with the pattern given. False if it is not positive definite. Throws EngineError if memory does not
  /// suffice.
  bool factorize(const SymmetricMatrix& matrix);

  /// For one right side or several, a column each.
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& rightSides) const;

  /// The matrix condensed onto `last` (its Schur complement).
  Eigen::MatrixXd condensed() const;

  /// Entries of the factor: what one solution reads twice.
  std::size_t entries() const;

private:
  struct Private;
  std::unique_ptr<Private> d;
};

} // namespace surgicalmesher
