// SPDX-License-Identifier: Apache-2.0
#include "SparseCholesky.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>

using namespace surgicalmesher;

namespace
{

/// Random and diagonally dominant.
SymmetricMatrix randomMatrix(int size)
{
  std::mt19937 random(3);
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < size; ++row)
  {
    entries.emplace_back(row, row, 20);
    for (int k = 0; k < 4 && row > 0; ++k)
      entries.emplace_back(row, int(random() % unsigned(row)), double(random() % 100) / 50 - 1);
  }
  SymmetricMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::MatrixXd dense(const SymmetricMatrix& matrix) { return Eigen::MatrixXd(matrix).selfadjointView<Eigen::Lower>(); }

} // namespace

TEST(SparseCholesky, SolvesForSeveralRightSides)
{
  const SymmetricMatrix matrix = randomMatrix(200);
  SparseCholesky factor(matrix);
  ASSERT_TRUE(factor.factorize(matrix));
  const Eigen::MatrixXd right = Eigen::MatrixXd::Random(200, 3);
  EXPECT_LT((dense(matrix) * factor.solve(right) - right).norm(), 1e-12 * right.norm());
  EXPECT_GE(factor.entries(), 200u);
}

TEST(SparseCholesky, CondensesOntoTheLastInTheirOrder)
{
  const SymmetricMatrix matrix = randomMatrix(150);
  const std::vector<std::int32_t> last{ 17, 140, 3, 99, 98, 0 };
  SparseCholesky factor(matrix, last);
  ASSERT_TRUE(factor.factorize(matrix));
  const Eigen::MatrixXd inverse = dense(matrix).inverse();
  const Eigen::MatrixXd expected = Eigen::MatrixXd(inverse(last, last)).inverse();
  EXPECT_LT((factor.condensed() - expected).norm(), 1e-11 * expected.norm());
}

TEST(SparseCholesky, CondensesOntoAllUnknowns)
{
  const SymmetricMatrix matrix = randomMatrix(5);
  SparseCholesky factor(matrix, { 4, 2, 0, 1, 3 });
  ASSERT_TRUE(factor.factorize(matrix));
  const std::vector<int> order{ 4, 2, 0, 1, 3 };
  EXPECT_LT((factor.condensed() - dense(matrix)(order, order)).norm(), 1e-12 * dense(matrix).norm());
}

TEST(SparseCholesky, SaysThatAMatrixIsNotPositiveDefinite)
{
  SymmetricMatrix matrix = randomMatrix(50);
  SparseCholesky factor(matrix);
  matrix.coeffRef(20, 20) = -1;
  EXPECT_FALSE(factor.factorize(matrix));
  matrix.coeffRef(20, 20) = 20;
  EXPECT_TRUE(factor.factorize(matrix));
}
