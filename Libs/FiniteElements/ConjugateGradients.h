// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conjugate gradients with Jacobi preconditioning, and the eigenvalues and modes of the matrix that they yield.

#include "StiffnessMatrix.h"

#include <functional>
#include <vector>

namespace surgicalmesher
{

/// One vector (displacement or force) per block row.
using NodalVector = std::vector<Vec3>;

double dot(const NodalVector& a, const NodalVector& b);

/// Symmetric tridiagonal matrix: the projection of the preconditioned matrix onto the Krylov space of conjugate
/// gradients (Golub, Van Loan, Matrix Computations, 10.2). Its eigenvalues lie within the range of those of the matrix,
/// and the outer ones converge first; in finite precision, copies of eigenvalues found early appear.
struct LanczosMatrix
{
  std::vector<double> diagonal, beside;
  double next = 0; ///< the next off-diagonal entry, beside the last diagonal one

  int size() const { return static_cast<int>(diagonal.size()); }

  /// Returns the eigenvalue that exactly `below` others are smaller than, by bisection with Sturm's sequence. All
  /// eigenvalues are positive and at most 12, since those of an element's matrix preconditioned by its own diagonal are
  /// at most its trace.
  double eigenvalue(int below) const;
  double smallest() const { return eigenvalue(0); }
  double largest() const { return eigenvalue(size() - 1); }

  /// Returns the eigenvector of an eigenvalue, of length 1, by twisted factorisation (Dhillon, Parlett, SIAM Journal on
  /// Matrix Analysis and Applications 25(3), 2004).
  std::vector<double> eigenvector(double eigenvalue) const;
};

struct Solution
{
  LanczosMatrix lanczos;
  int iterations = 0;
  bool converged = false;
};

/// Called before every iteration with the residual and its product with the preconditioned residual.
using ResidualObserver = std::function<void(int iteration, const NodalVector& residual, double product)>;

/// Solves until the residual norm is at most `tolerance` times that of the load. This is the recursively updated
/// residual, which can fall arbitrarily far; a small tolerance improves the eigenvalues. The result does not depend on
/// the number of threads.
Solution solve(const BlockMatrix& matrix, const NodalVector& load, double tolerance,
               const ResidualObserver& observer = {});

/// An eigenmode of the matrix scaled symmetrically by its diagonal.
struct ScaledMode
{
  double eigenvalue = 0;
  NodalVector shape; ///< in the scaled unknowns, of length 1
};

/// Returns the modes of the lowest eigenvalues that the solution of solve(matrix, load, tolerance) contains with a
/// residual below a hundredth of the eigenvalue: at most `most`, ascending, without copies. Solves the system again,
/// since the vectors that the modes are combined from are too many to be kept.
std::vector<ScaledMode> lowestModes(const BlockMatrix& matrix, const NodalVector& load, const Solution& solution,
                                    double tolerance, int most);

} // namespace surgicalmesher
