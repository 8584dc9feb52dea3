// SPDX-License-Identifier: Apache-2.0
#include "PairMatrix.h"

#include <gtest/gtest.h>
#include <vtkMath.h>

#include <cmath>
#include <cstddef>
#include <random>

namespace surgicalmesher
{
namespace
{

/// Products of `rank` random vectors, divided by their diagonal.
PairMatrix randomMatrix(std::size_t rank, std::mt19937& random)
{
  std::normal_distribution<double> normal;
  std::array<std::array<double, 12>, 6> rows{};
  for (auto& row : rows)
    for (std::size_t n = 0; n < rank; ++n) row[n] = normal(random);
  const auto product = [&](int i, int k)
  {
    double sum = 0;
    for (std::size_t n = 0; n < rank; ++n) sum += rows[i][n] * rows[k][n];
    return sum;
  };
  PairMatrix result;
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) result[i][k] = product(i, k) / std::sqrt(product(i, i) * product(k, k));
  return result;
}

/// By Jacobi's rotations.
double expectedLargest(PairMatrix matrix)
{
  PairMatrix vectors;
  std::array<double, 6> values;
  std::array<double*, 6> rows, columns;
  for (int i = 0; i < 6; ++i) rows[i] = matrix[i].data(), columns[i] = vectors[i].data();
  vtkMath::JacobiN(rows.data(), 6, values.data(), columns.data());
  return values[0];
}

PairMatrix identity()
{
  PairMatrix result{};
  for (int i = 0; i < 6; ++i) result[i][i] = 1;
  return result;
}

TEST(PairMatrix, HasTheLargestEigenvalueThatRotationsFind)
{
  std::mt19937 random(3);
  for (const std::size_t rank : { 1, 2, 3, 6, 12 })
    for (int n = 0; n < 200; ++n)
    {
      const PairMatrix matrix = randomMatrix(rank, random);
      const double largest = expectedLargest(matrix);
      EXPECT_NEAR(largestEigenvalue(matrix), largest, 1e-12 * largest) << "rank " << rank;
      EXPECT_TRUE(areEigenvaluesBelow((1 + 1e-9) * largest, matrix));
      EXPECT_FALSE(areEigenvaluesBelow((1 - 1e-9) * largest, matrix));
    }
}

TEST(PairMatrix, MayHaveEqualEigenvaluesAndZeros)
{
  EXPECT_NEAR(largestEigenvalue(identity()), 1, 1e-15);
  PairMatrix twice = identity(); // 1.5 and 0.5 three times each
  for (int i = 0; i < 3; ++i) twice[i][i + 3] = twice[i + 3][i] = 0.5;
  EXPECT_NEAR(largestEigenvalue(twice), 1.5, 1e-6);
  EXPECT_TRUE(areEigenvaluesBelow(1.5 + 1e-9, twice));
  EXPECT_FALSE(areEigenvaluesBelow(1.5 - 1e-9, twice));
  PairMatrix circulant = identity(); // 1.2 four times and 0.6 twice
  for (int i = 0; i < 6; ++i)
    for (const int step : { 2, 4 }) circulant[i][(i + step) % 6] = -0.2;
  EXPECT_NEAR(largestEigenvalue(circulant), 1.2, 1e-5);
  PairMatrix last = identity();
  last[4][5] = last[5][4] = -0.25;
  EXPECT_NEAR(largestEigenvalue(last), 1.25, 1e-14);
}

TEST(PairMatrix, NoneIsBelowTheMean)
{
  EXPECT_FALSE(areEigenvaluesBelow(1, identity()));
  EXPECT_FALSE(areEigenvaluesBelow(0.5, identity()));
}

} // namespace
} // namespace surgicalmesher
