// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Cost of a mesh to an iterative solver: the conditioning of its stiffness matrix.

#include "TetMesh.h"

namespace surgicalmesher
{

/// A mode in which only few nodes take part, such as that of an ear, a flap or a strand.
struct LocalMode
{
  double eigenvalue = 0;
  /// Effective share of the nodes that take part: 1 / (number of nodes x sum of the squares of their parts).
  double nodeShare = 0;
  Vec3 place;      ///< mm; mean of the nodes, weighted by their parts
  Label label = 0; ///< of a tetrahedron at the node with the largest part
};

/// Modes with a smaller nodeShare are local.
constexpr double kLocalShare = 0.02;

/// Properties of the stiffness matrix after Jacobi preconditioning (symmetric scaling by its diagonal).
struct StiffnessConditioning
{
  std::size_t unknowns = 0; ///< three per free point
  int iterations = 0;       ///< conjugate gradients until the residual has fallen to 1e-8 of the load
  /// Iterations over the cube root of the unknowns, a measure independent of the element size.
  double iterationsPerCubeRoot = 0;
  /// False where all held points lie on a line, around which the mesh can rotate.
  bool converged = false;
  // The following are 0 or empty if not converged.
  double smallestEigenvalue = 0, largestEigenvalue = 0;
  double condition = 0;              ///< condition number: largestEigenvalue / smallestEigenvalue
  std::vector<LocalMode> localModes; ///< those among the 20 lowest; ascending
};

/// Computes the conditioning for linear elasticity on linear tetrahedra of a single material, so that only the mesh
/// matters: Poisson's ratio 0.4; Young's modulus has no influence. Points are held as numberFreePoints() describes. The
/// load for the iterations is the body's own weight. The eigenvalues are those of the Lanczos matrices of conjugate
/// gradients, from the weight and from pseudo-random forces, as the weight alone does not excite some modes. `mesh`
/// must meet requireSound() and have no label 0. The result does not depend on the number of threads.
StiffnessConditioning stiffnessConditioning(const TetMesh& mesh);

} // namespace surgicalmesher
