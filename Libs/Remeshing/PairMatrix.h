// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Eigenvalues of the stiffness matrix of two vertices, scaled by its diagonal.

#include <array>

namespace surgicalmesher
{

/// Symmetric and positive semidefinite, with ones on the diagonal; three rows per vertex.
using PairMatrix = std::array<std::array<double, 6>, 6>;

/// Returns whether all eigenvalues of `matrix` are below `bound`.
bool areEigenvaluesBelow(double bound, const PairMatrix& matrix);

/// Returns the largest eigenvalue to about 1e-14, or 1e-5 if it is a multiple one. Softening computes 190,000 of them
/// in a noisy head: this takes 0.3 us each, library routines that find all six eigenvalues 1.4 us (ITK) and 2.8 us
/// (VTK).
double largestEigenvalue(const PairMatrix& matrix);

} // namespace surgicalmesher
