// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pairs of neighbouring vertices that are stiff beside what else holds them: few and flat tetrahedra at the end of a
/// short edge. There the stiffness matrix, divided by its diagonal as by the Jacobi preconditioner, has its largest
/// eigenvalues, each of which costs conjugate gradients an iteration or more where it stands alone.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct StiffPairOptions
{
  double eigenvalue = 1.85; ///< pairs with a larger one are worked on, one in a hundred
  double goodAngle = 28.6;  ///< degrees; no dihedral angle falls below this, or falls if it is below
  double reach = 0.15;      ///< share of L, of each vertex, for each of its pairs
  double ease = 0.02;       ///< see heldAt: surfaces lose their smoothness otherwise
  int trials = 24;          ///< positions tried for each vertex
};

/// Largest eigenvalue of the scaled stiffness of two vertices of tissues alone, all others held: of the 6 x 6 matrix of
/// their rows and columns, divided by its diagonal. Linear elasticity with Poisson's ratio 0.4, tissues alike. Between 1
/// and 6. Goes through all tetrahedra.
double pairEigenvalue(const TetComplex& complex, std::int32_t a, std::int32_t b);

/// Stiffest first: moves both vertices of a pair, each where the largest eigenvalue of its own pairs falls. Vertices of
/// the interface move as far as the envelope allows, along their samples rather than off them. For the whole mesh in one
/// block: at borders of blocks pairs seem stiffer than they are.
void softenPairsOfBlock(GuardedOperations& operations, const StiffPairOptions& options = {});

} // namespace surgicalmesher
