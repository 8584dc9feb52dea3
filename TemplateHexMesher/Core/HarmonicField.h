// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Harmonic fields on tetrahedra: smooth coordinates of a body from values on parts of its boundary.

#include "ElementMesh.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include <array>
#include <vector>

namespace surgicalmesher
{

/// A tetrahedral mesh of positively oriented cells without unused points.
struct Tetrahedra
{
  Points points;
  std::vector<std::array<std::int32_t, 4>> cells;
};

/// Returns the stiffness matrix with the weights of Liao et al., "Volumetric parameterization and trivariate B-spline
/// fitting using harmonic functions", 2009, as used by Kim et al. 2018, equation 3. Off-diagonal entries are -w_ij,
/// with w_ij the sum of l cot(theta) / 6 over the tetrahedra at edge ij, where l is the length of the opposite edge and
/// theta the dihedral angle there. The matrix is assembled from gradients of the linear shape functions, which is
/// equivalent.
Eigen::SparseMatrix<double> harmonicWeights(const Tetrahedra& mesh);

/// Returns the gradient of a field given by point: one column per tetrahedron.
Points gradientOf(const Tetrahedra& mesh, const Eigen::VectorXd& field);

/// Returns the component of each column of `gradient` that is orthogonal to the same column of `other`. (Equation 4 of
/// the paper, which is identically zero as printed; meant is (g . d) d, with d the unit vector along (other x g) x
/// other.)
Points orthogonalised(const Points& gradient, const Points& other);

/// Solves for fields with given values at some of the points.
class FieldSolver
{
public:
  /// `known` has a flag per point; at least one must be set in every connected component. `mesh` must outlive the
  /// solver. Throws EngineError if the matrix cannot be factorised.
  FieldSolver(const Tetrahedra& mesh, std::vector<char> known);

  /// Returns the harmonic field with the given values at the known points.
  Eigen::VectorXd harmonic(const Eigen::VectorXd& values) const;

  /// Returns the field whose gradient is closest to `gradient` in the least-squares sense, with the given values at the
  /// known points.
  Eigen::VectorXd restored(const Points& gradient, const Eigen::VectorXd& values) const;

private:
  Eigen::VectorXd solve(const Eigen::VectorXd& values, const Eigen::VectorXd& divergence) const;

  const Tetrahedra& m_Mesh;
  std::vector<char> m_Known;
  std::vector<std::int32_t> m_Row; ///< per point: row among the unknown points, -1 for a known one
  Eigen::SparseMatrix<double> m_Weights;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> m_Factor;
};

} // namespace surgicalmesher
