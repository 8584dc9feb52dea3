// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Elastic bodies of linear tetrahedra. Lengths are in mm, moduli in MPa, forces in N. In vectors of unknowns, the
/// three components of free point p are at 3 p, 3 p + 1, 3 p + 2.

#include "LinearTetrahedron.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace surgicalmesher
{

/// A symmetric matrix, of which only the lower triangle is stored.
using SymmetricMatrix = Eigen::SparseMatrix<double>;

struct ElasticBody
{
  TetMesh mesh;
  std::vector<LameConstants> lame;    ///< per tetrahedron
  std::vector<std::int32_t> unknowns; ///< per point: its number among the free points; -1: held fixed
  std::int32_t freePoints = 0;

  Eigen::Index size() const { return 3 * Eigen::Index(freePoints); }
};

/// Stiffness matrix for small displacements, N/mm.
SymmetricMatrix linearStiffness(const ElasticBody& body);

/// Forces on the free points from a uniform force per volume (N/mm^3).
Eigen::VectorXd weightOf(const ElasticBody& body, const Vec3& forcePerVolume);

/// A compressible neo-Hookean body, W = mu/2 (tr F'F - 3) - mu ln J + lambda/2 (ln J)^2 (Bonet, Wood, Nonlinear
/// Continuum Mechanics for Finite Element Analysis, 6.4.3). Its tangent at rest is linearStiffness().
struct NeoHookean
{
  /// Energy, N mm; infinite if a tetrahedron is inverted.
  static double energy(const ElasticBody& body, const Eigen::VectorXd& displacement);
  /// Gradient of the energy, N.
  static Eigen::VectorXd forces(const ElasticBody& body, const Eigen::VectorXd& displacement);
  /// Second derivative of the energy, N/mm. `definite`: removes the negative eigenvalues of every element's matrix, for
  /// a step where the whole matrix is not positive definite.
  static SymmetricMatrix tangent(const ElasticBody& body, const Eigen::VectorXd& displacement, bool definite = false);
};

} // namespace surgicalmesher
