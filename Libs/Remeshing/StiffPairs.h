// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Softens pairs of neighbouring vertices whose coupling is stiff compared with their other supports, as at the end of
/// a short edge with few, flat tetrahedra. Such pairs cause the largest eigenvalues of the stiffness matrix with Jacobi
/// preconditioning (divided by its diagonal). Each isolated eigenvalue costs conjugate gradients an iteration or more.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct StiffPairOptions
{
  double eigenvalue = 1.85; ///< pairs with a larger eigenvalue are processed, about one in a hundred
  double goodAngle = 28.6;  ///< degrees; no dihedral angle falls below this, or falls further if it is below already
  double reach = 0.15;      ///< largest displacement of a vertex, as a share of L, for each of its pairs
  double ease = 0.02;       ///< see heldAt; larger values roughen surfaces
  int trials = 24;          ///< positions tried for each vertex
};

/// Returns the largest eigenvalue, between 1 and 6, of the 6 x 6 stiffness matrix of vertices a and b with all other
/// vertices fixed, scaled by its diagonal. Linear elasticity with Poisson's ratio 0.4 and the same stiffness in all
/// tissues; background does not count. Visits all tetrahedra of the complex.
double pairEigenvalue(const TetComplex& complex, std::int32_t a, std::int32_t b);

/// Processes stiff pairs, stiffest first: moves each vertex of a pair so that the largest eigenvalue among all its
/// pairs falls. Interface vertices move as far as the envelope allows, preferably along the boundary that their samples
/// define. For the whole mesh in one block: at block borders, where tetrahedra are missing, pairs seem stiffer than
/// they are.
void softenPairsOfBlock(GuardedOperations& operations, const StiffPairOptions& options = {});

} // namespace surgicalmesher
