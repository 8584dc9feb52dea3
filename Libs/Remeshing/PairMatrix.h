// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Eigenvalues of the scaled stiffness of two vertices.

#include <array>

namespace surgicalmesher
{

/// Symmetric and positive semidefinite, with ones on the diagonal: three rows for each vertex.
using PairMatrix = std::array<std::array<double, 6>, 6>;

/// Whether all eigenvalues are.
bool areEigenvaluesBelow(double bound, const PairMatrix& matrix);

/// To about 1e-14, or 1e-5 where several of the largest are equal.
double largestEigenvalue(const PairMatrix& matrix);

} // namespace surgicalmesher
