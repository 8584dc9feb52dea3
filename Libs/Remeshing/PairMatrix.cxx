// SPDX-License-Identifier: Apache-2.0
#include "PairMatrix.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

constexpr int size = 6;

/// A sufficient test: the largest eigenvalue is at most 1 + sqrt(5 / 6) |m - I| in the Frobenius norm (Wolkowicz and
/// Styan 1980). Decides three of four cases at a tenth of the cost of a Cholesky factor.
bool areClearlyBelow(double bound, const PairMatrix& m)
{
  constexpr double margin = 1e-6; // for rounding errors
  double squares = 0;             // of the entries below the diagonal: half the squared norm of m - I
  for (int i = 1; i < size; ++i)
    for (int k = 0; k < i; ++k) squares += m[i][k] * m[i][k];
  const double most = bound - 1;
  return most > 0 && 5.0 / 3 * squares < (1 - margin) * most * most;
}

/// Returns whether bound I - m has a Cholesky factor, that is, is positive definite.
bool hasCholeskyFactor(double bound, const PairMatrix& m)
{
  PairMatrix factor;
  for (int i = 0; i < size; ++i)
    for (int k = 0; k <= i; ++k)
    {
      double rest = (i == k ? bound : 0) - m[i][k];
      for (int j = 0; j < k; ++j) rest -= factor[i][j] * factor[k][j];
      if (i == k && !(rest > 0)) return false;
      factor[i][k] = i == k ? std::sqrt(rest) : rest / factor[k][k];
    }
  return true;
}

struct Tridiagonal
{
  std::array<double, size> diagonal;
  std::array<double, size - 1> offDiagonalSquares;
};

/// Applies to the rows and columns after k the Householder reflection that zeroes column k below its first subdiagonal
/// entry, and returns the square of that entry. Column k itself is not updated.
double reflect(PairMatrix& m, int k)
{
  const int first = k + 1;
  double square = 0;
  for (int i = first; i < size; ++i) square += m[i][k] * m[i][k];
  std::array<double, size> v{}, w{};
  for (int i = first; i < size; ++i) v[i] = m[i][k];
  v[first] += std::copysign(std::sqrt(square), v[first]);
  const double half = square + std::abs(m[first][k]) * std::sqrt(square); // |v|^2 / 2
  if (half == 0) return 0;
  double along = 0;
  for (int i = first; i < size; ++i)
  {
    for (int j = first; j < size; ++j) w[i] += m[i][j] * v[j] / half;
    along += w[i] * v[i] / (2 * half);
  }
  for (int i = first; i < size; ++i) w[i] -= along * v[i];
  for (int i = first; i < size; ++i)
    for (int j = first; j < size; ++j) m[i][j] -= v[i] * w[j] + w[i] * v[j];
  return square;
}

Tridiagonal tridiagonalOf(PairMatrix m)
{
  Tridiagonal result;
  for (int k = 0; k + 1 < size; ++k) result.offDiagonalSquares[k] = reflect(m, k);
  for (int i = 0; i < size; ++i) result.diagonal[i] = m[i][i];
  return result;
}

/// Gershgorin's bound on the largest eigenvalue.
double upperBound(const Tridiagonal& t)
{
  double most = 0;
  for (int i = 0; i < size; ++i)
  {
    const double before = i > 0 ? std::sqrt(t.offDiagonalSquares[i - 1]) : 0;
    const double after = i + 1 < size ? std::sqrt(t.offDiagonalSquares[i]) : 0;
    most = std::max(most, t.diagonal[i] + before + after);
  }
  return most;
}

/// Returns the characteristic polynomial at x divided by its derivative.
double newtonStep(const Tridiagonal& t, double x)
{
  double p = x - t.diagonal[0], slope = 1, lastP = 1, lastSlope = 0;
  for (int i = 1; i < size; ++i)
  {
    const double factor = x - t.diagonal[i], square = t.offDiagonalSquares[i - 1];
    const double nextSlope = p + factor * slope - square * lastSlope, next = factor * p - square * lastP;
    lastP = p, lastSlope = slope;
    p = next, slope = nextSlope;
  }
  return p / slope;
}

} // namespace

bool areEigenvaluesBelow(double bound, const PairMatrix& matrix)
{
  return areClearlyBelow(bound, matrix) || hasCholeskyFactor(bound, matrix);
}

double largestEigenvalue(const PairMatrix& matrix)
{
  constexpr int enough = 60; // where the two largest are equal, each step only halves the error
  const Tridiagonal t = tridiagonalOf(matrix);
  double x = upperBound(t); // from above all roots, Newton's method decreases monotonically
  for (int n = 0; n < enough; ++n)
  {
    const double step = newtonStep(t, x);
    if (!(step > 1e-15 * x && step < x)) break; // rounding errors prevail, possibly in the derivative as well
    x -= step;
  }
  return x;
}

} // namespace surgicalmesher
