// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a mesh costs an iterative solver: the conditioning of its stiffness matrix.

#include "TetMesh.h"

namespace surgicalmesher
{

/// A mode that few nodes have a part in: an ear, a flap, a strand.
struct LocalMode
{
  double eigenvalue = 0;
  double nodeShare = 0; ///< one over the number of nodes and the sum of the squares of their parts
  Vec3 place;           ///< mm; mean of the nodes, weighed by their parts
  Label label = 0;      ///< of a tetrahedron at the node with the largest part
};

/// Modes of fewer nodes are local.
constexpr double kLocalShare = 0.02;

/// Of the stiffness matrix after Jacobi preconditioning (division by its diagonal).
struct StiffnessConditioning
{
  std::size_t unknowns = 0;         ///< three per point that is free
  int iterations = 0;               ///< conjugate gradients until the residual has fallen to 1e-8 of the load
  double iterationsPerCubeRoot = 0; ///< of the unknowns: what remains of iterations whatever the size of elements
  bool converged = false; ///< false where all points that are held lie on a line, around which the mesh can swing
  // 0 and empty if not converged:
  double smallestEigenvalue = 0, largestEigenvalue = 0;
  double condition = 0;              ///< the largest over the smallest
  std::vector<LocalMode> localModes; ///< those among the 20 lowest; ascending
};

/// Linear elasticity of linear tetrahedra of one material, so that the mesh alone counts: Poisson's ratio 0.4; Young's
/// modulus has no influence. Points are held as numberFreePoints() says. The load is the body's own weight. The
/// eigenvalues are those of the Lanczos matrices that conjugate gradients build, from the weight and from forces
/// scattered at random, as the weight alone leaves some modes at rest. `mesh` as requireSound() has it, without label 0.
/// Deterministic, whatever the number of threads.
StiffnessConditioning stiffnessConditioning(const TetMesh& mesh);

} // namespace surgicalmesher
