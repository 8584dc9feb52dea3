// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Elastic bodies of linear tetrahedra. Lengths in mm, moduli in MPa, forces in N. Vectors of unknowns have the three
/// components of point p at 3 p, 3 p + 1, 3 p + 2.

#include "LinearTetrahedron.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace surgicalmesher
{

/// Symmetric; the lower triangle alone is stored.
using SymmetricMatrix = Eigen::SparseMatrix<double>;

struct ElasticBody
{
  TetMesh mesh;
  std::vector<LameConstants> lame;    ///< per tetrahedron
  std::vector<std::int32_t> unknowns; ///< per point: its number among those that are free, -1: it is held
  std::int32_t freePoints = 0;

  Eigen::Index size() const { return 3 * Eigen::Index(freePoints); }
};

/// The stiffness of small displacements, N/mm.
SymmetricMatrix linearStiffness(const ElasticBody& body);

/// Forces on the free points of a uniform force per volume, N/mm^3.
Eigen::VectorXd weightOf(const ElasticBody& body, const Vec3& forcePerVolume);

/// A compressible neo-Hookean body, W = mu/2 (tr F'F - 3) - mu ln J + lambda/2 (ln J)^2 (Bonet, Wood, Nonlinear Continuum
/// Mechanics for Finite Element Analysis, 6.4.3), whose tangent at rest is linearStiffness().
struct NeoHookean
{
  /// N mm; infinity if a tetrahedron is turned over.
  static double energy(const ElasticBody& body, const Eigen::VectorXd& displacement);
  /// Its gradient, N.
  static Eigen::VectorXd forces(const ElasticBody& body, const Eigen::VectorXd& displacement);
  /// Its second derivative, N/mm. `definite`: every element's matrix without its negative eigenvalues, for a step where
  /// the whole is not positive definite.
  static SymmetricMatrix tangent(const ElasticBody& body, const Eigen::VectorXd& displacement, bool definite = false);
};

} // namespace surgicalmesher
