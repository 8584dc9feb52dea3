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

/// Positively wound, every point used.
struct Tetrahedra
{
  Points points;
  std::vector<std::array<std::int32_t, 4>> cells;
};

/// The weights of Liao et al., "Volumetric parameterization and trivariate B-spline fitting using harmonic functions",
/// 2009, as Kim et al. 2018, equation 3, use them: off the diagonal -w_ij with w_ij the sum over the tetrahedra at an
/// edge of l cot(theta) / 6, l the length of the opposite edge and theta the dihedral angle there. Assembled from
/// gradients of the linear shape functions, which is the same matrix.
Eigen::SparseMatrix<double> harmonicWeights(const Tetrahedra& mesh);

/// Of a field with a value per point: one column per tetrahedron.
Points gradientOf(const Tetrahedra& mesh, const Eigen::VectorXd& field);

/// What of each column of `gradient` is orthogonal to the same column of `other`. (Equation 4 of the paper, which as
/// printed is identically zero: (g . d) d, d the unit vector along (other x g) x other.)
Points orthogonalised(const Points& gradient, const Points& other);

/// Fields that take given values at some of the points.
class FieldSolver
{
public:
  /// `known` has a flag per point, at least one set in every connected part. Throws EngineError if the weights can't be
  /// factored.
  FieldSolver(const Tetrahedra& mesh, std::vector<char> known);

  /// The harmonic field that is `values` at the known points.
  Eigen::VectorXd harmonic(const Eigen::VectorXd& values) const;

  /// The field whose gradient is next to `gradient` in the sense of least squares, and `values` at the known points.
  Eigen::VectorXd restored(const Points& gradient, const Eigen::VectorXd& values) const;

private:
  Eigen::VectorXd solve(const Eigen::VectorXd& values, const Eigen::VectorXd& divergence) const;

  const Tetrahedra& m_Mesh;
  std::vector<char> m_Known;
  std::vector<std::int32_t> m_Row; ///< per point: among the unknown ones, or -1
  Eigen::SparseMatrix<double> m_Weights;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> m_Factor;
};

} // namespace surgicalmesher
