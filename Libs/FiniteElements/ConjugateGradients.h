// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conjugate gradients, preconditioned by the diagonal, and what they tell of a matrix: its eigenvalues and modes.

#include "StiffnessMatrix.h"

#include <functional>
#include <vector>

namespace surgicalmesher
{

/// One value or force per row.
using NodalVector = std::vector<Vec3>;

double dot(const NodalVector& a, const NodalVector& b);

/// Symmetric tridiagonal: the preconditioned matrix as seen in the space that conjugate gradients search (Golub, Van
/// Loan, Matrix Computations, 10.2). Its eigenvalues lie within those of the matrix, the outer ones soon at them; in
/// finite precision there are copies of those that were found early.
struct LanczosMatrix
{
  std::vector<double> diagonal, beside;
  double next = 0; ///< what would stand beside the last diagonal

  int size() const { return static_cast<int>(diagonal.size()); }

  /// The eigenvalue that `below` others are smaller than, by bisection with Sturm's sequence. All are positive and at
  /// most 12: an element's matrix has at most the trace of its own diagonal's.
  double eigenvalue(int below) const;
  double smallest() const { return eigenvalue(0); }
  double largest() const { return eigenvalue(size() - 1); }

  /// The eigenvector of an eigenvalue, of length 1, by twisted factorisation (Dhillon, Parlett, SIAM Journal on Matrix
  /// Analysis and Applications 25(3), 2004).
  std::vector<double> eigenvector(double eigenvalue) const;
};

struct Solution
{
  LanczosMatrix lanczos;
  int iterations = 0;
  bool converged = false;
};

/// Is told before every iteration the residual, and the preconditioned one's product with it.
using ResidualObserver = std::function<void(int iteration, const NodalVector& residual, double product)>;

/// Until the residual is `tolerance` of the load; that is the one that iterations carry on, which can fall as far as one
/// likes: eigenvalues come out the better for it. Deterministic, whatever the number of threads.
Solution solve(const BlockMatrix& matrix, const NodalVector& load, double tolerance,
               const ResidualObserver& observer = {});

/// A mode of the matrix after division by its diagonal.
struct ScaledMode
{
  double eigenvalue = 0;
  NodalVector shape; ///< in the scaled unknowns; of length 1
};

/// The modes of the lowest eigenvalues that the solution of solve(matrix, load, tolerance) has found, with a residual of
/// less than a hundredth of them; `most` of them at most, ascending, each once. Solves again, as the vectors that they
/// are sums of are too many to be kept.
std::vector<ScaledMode> lowestModes(const BlockMatrix& matrix, const NodalVector& load, const Solution& solution,
                                    double tolerance, int most);

} // namespace surgicalmesher
