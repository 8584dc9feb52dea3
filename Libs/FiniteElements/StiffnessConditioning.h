// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a mesh costs an iterative solver: the conditioning of its stiffness matrix.

#include "TetMesh.h"

namespace surgicalmesher
{

/// Of the stiffness matrix after Jacobi preconditioning (division by its diagonal).
struct StiffnessConditioning
{
  std::size_t unknowns = 0; ///< three per point that is free
  double condition = 0;     ///< largest over smallest eigenvalue; 0 if not converged
  int iterations = 0;       ///< conjugate gradients until the residual has fallen to 1e-8 of the load
  bool converged = false;   ///< false where all points that are held lie on a line, around which the mesh can swing
};

/// Linear elasticity of linear tetrahedra of one material, so that the mesh alone counts: Poisson's ratio 0.4; Young's
/// modulus has no influence. Of each piece (tetrahedra joined through faces) the outermost points towards -z are held:
/// the lowest twentieth, three at least, and all that are as low. The load is the body's own weight. The eigenvalues
/// are those of the Lanczos matrices that conjugate gradients build (Golub, Van Loan, Matrix Computations, 10.2), from
/// the weight and from forces scattered at random, as the weight alone leaves some modes at rest. `mesh` as
/// requireSound() has it, without label 0. Deterministic, whatever the number of threads.
StiffnessConditioning stiffnessConditioning(const TetMesh& mesh);

} // namespace surgicalmesher
