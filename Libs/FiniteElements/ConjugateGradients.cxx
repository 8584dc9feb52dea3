// SPDX-License-Identifier: Apache-2.0
#include "ConjugateGradients.h"

#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace surgicalmesher
{
namespace
{

void multiply(const BlockMatrix& matrix, const NodalVector& x, NodalVector& y)
{
  const auto row = [&](std::size_t i)
  {
    Vec3 sum;
    for (std::int64_t k = matrix.rowStart[i]; k < matrix.rowStart[i + 1]; ++k)
    {
      const BlockMatrix::Block& m = matrix.blocks[k];
      const Vec3& v = x[matrix.columns[k]];
      sum += Vec3{ m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
                   m[6] * v.x + m[7] * v.y + m[8] * v.z };
    }
    y[i] = sum;
  };
  parallelFor(std::size_t(matrix.rows()), row);
}

NodalVector inverseDiagonal(const BlockMatrix& matrix)
{
  NodalVector result(matrix.rows());
  for (std::int32_t row = 0; row < matrix.rows(); ++row)
  {
    const BlockMatrix::Block& m = matrix.blocks[matrix.indexOf(row, row)];
    result[row] = { 1 / m[0], 1 / m[4], 1 / m[8] };
  }
  return result;
}

/// Returns the number of eigenvalues of a Lanczos matrix below x, by Sturm's sequence.
int countBelow(const LanczosMatrix& lanczos, double x)
{
  int count = 0;
  double pivot = 1;
  for (std::size_t i = 0; i < lanczos.diagonal.size(); ++i)
  {
    const double beside = i > 0 ? lanczos.beside[i - 1] : 0;
    pivot = lanczos.diagonal[i] - x - beside * beside / pivot;
    if (pivot == 0) pivot = std::numeric_limits<double>::min();
    if (pivot < 0) ++count;
  }
  return count;
}

/// An eigenpair of the Lanczos matrix that is also one of the whole matrix, up to a small residual.
struct RitzPair
{
  double value;
  std::vector<double> weights; ///< coefficients of the Lanczos vectors
};

std::vector<RitzPair> lowestRitzPairs(const LanczosMatrix& lanczos, int most)
{
  constexpr double enough = 1e-2, same = 1e-6;
  std::vector<RitzPair> pairs;
  const int tried = std::min(lanczos.size(), 2 * most); // about half of them are copies
  for (int k = 0; k < tried && int(pairs.size()) < most; ++k)
  {
    const double value = lanczos.eigenvalue(k);
    if (!pairs.empty() && value < (1 + same) * pairs.back().value) continue; // a copy
    std::vector<double> weights = lanczos.eigenvector(value);
    if (std::abs(lanczos.next * weights.back()) < enough * value) pairs.push_back({ value, std::move(weights) });
  }
  return pairs;
}

void normalize(NodalVector& vector)
{
  const double length = std::sqrt(dot(vector, vector));
  for (Vec3& v : vector) v = v / length;
}

} // namespace

double dot(const NodalVector& a, const NodalVector& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

double LanczosMatrix::eigenvalue(int below) const
{
  double low = 0, high = 12;
  while (high - low > 1e-12 * high)
  {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (countBelow(*this, middle) > below ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<double> LanczosMatrix::eigenvector(double eigenvalue) const
{
  const int n = size();
  const auto notZero = [](double pivot) { return pivot == 0 ? 1e-300 : pivot; };
  std::vector<double> down(n), up(n); // pivots of the eliminations from the two ends
  for (int i = 0; i < n; ++i)
    down[i] = notZero(diagonal[i] - eigenvalue - (i > 0 ? beside[i - 1] * beside[i - 1] / down[i - 1] : 0));
  for (int i = n - 1; i >= 0; --i)
    up[i] = notZero(diagonal[i] - eigenvalue - (i < n - 1 ? beside[i] * beside[i] / up[i + 1] : 0));
  int twist = 0;
  const auto twisted = [&](int i) { return std::abs(down[i] + up[i] - (diagonal[i] - eigenvalue)); };
  for (int i = 1; i < n; ++i)
    if (twisted(i) < twisted(twist)) twist = i;
  std::vector<double> vector(n);
  vector[twist] = 1;
  for (int i = twist; i > 0; --i) vector[i - 1] = -beside[i - 1] / down[i - 1] * vector[i];
  for (int i = twist; i < n - 1; ++i) vector[i + 1] = -beside[i] / up[i + 1] * vector[i];
  const double length = std::sqrt(std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.0));
  for (double& v : vector) v /= length;
  return vector;
}

Solution solve(const BlockMatrix& matrix, const NodalVector& load, double tolerance, const ResidualObserver& observer)
{
  Solution solution;
  LanczosMatrix& lanczos = solution.lanczos;
  const NodalVector inverse = inverseDiagonal(matrix);
  const auto precondition = [&](const NodalVector& r, NodalVector& z)
  {
    for (std::size_t i = 0; i < r.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis) z[i][axis] = inverse[i][axis] * r[i][axis];
    }
  };
  NodalVector r = load, z(r.size()), product(r.size());
  precondition(r, z);
  NodalVector direction = z;
  const double enough = tolerance * tolerance * dot(load, load);
  const int most = 1000 + static_cast<int>(3 * load.size()); // more than n steps, since rounding delays convergence
  double rz = dot(r, z), turnBefore = 0, stepBefore = 1;
  for (; solution.iterations < most && dot(r, r) > enough; ++solution.iterations)
  {
    if (observer) observer(solution.iterations, r, rz);
    multiply(matrix, direction, product);
    const double energy = dot(direction, product);
    if (!(energy > 0)) return solution;
    const double step = rz / energy;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= step * product[i];
    precondition(r, z);
    const double turn = dot(r, z) / rz;
    for (std::size_t i = 0; i < r.size(); ++i) direction[i] = z[i] + turn * direction[i];
    if (solution.iterations > 0) lanczos.beside.push_back(lanczos.next);
    lanczos.diagonal.push_back(1 / step + turnBefore / stepBefore);
    lanczos.next = std::sqrt(turn) / step;
    stepBefore = step;
    turnBefore = turn;
    rz *= turn;
  }
  solution.converged = dot(r, r) <= enough;
  return solution;
}

std::vector<ScaledMode> lowestModes(const BlockMatrix& matrix, const NodalVector& load, const Solution& solution,
                                    double tolerance, int most)
{
  const std::vector<RitzPair> pairs = lowestRitzPairs(solution.lanczos, most);
  std::vector<ScaledMode> modes(pairs.size());
  for (std::size_t m = 0; m < modes.size(); ++m) modes[m] = { pairs[m].value, NodalVector(load.size()) };
  if (modes.empty()) return modes;
  NodalVector scale = inverseDiagonal(matrix);
  for (Vec3& s : scale) s = { std::sqrt(s.x), std::sqrt(s.y), std::sqrt(s.z) };
  const auto add = [&](int iteration, const NodalVector& r, double product)
  {
    const double sign = iteration % 2 == 0 ? 1 : -1; // the Lanczos vectors alternate in sign
    parallelForEach(modes.size(),
                    [&](std::size_t m)
                    {
                      const double weight = sign * pairs[m].weights[iteration] / std::sqrt(product);
                      for (std::size_t i = 0; i < r.size(); ++i) modes[m].shape[i] += weight * r[i];
                    });
  };
  solve(matrix, load, tolerance, add);
  for (ScaledMode& mode : modes)
  {
    for (std::size_t i = 0; i < scale.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) mode.shape[i][axis] *= scale[i][axis];
    normalize(mode.shape);
  }
  return modes;
}

} // namespace surgicalmesher
