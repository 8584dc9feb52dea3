// SPDX-License-Identifier: Apache-2.0
#include "HarmonicField.h"

#include "Errors.h"

#include <Eigen/Geometry>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// Gradients of the four shape functions, times the volume, and the volume.
struct ShapeGradients
{
  Eigen::Matrix<double, 3, 4> scaled;
  double volume;
};

ShapeGradients shapeGradients(const Tetrahedra& mesh, std::size_t cell)
{
  const auto& n = mesh.cells[cell];
  const Vector3d a = mesh.points.col(n[1]) - mesh.points.col(n[0]), b = mesh.points.col(n[2]) - mesh.points.col(n[0]),
                 c = mesh.points.col(n[3]) - mesh.points.col(n[0]);
  ShapeGradients result;
  result.scaled.col(1) = b.cross(c) / 6;
  result.scaled.col(2) = c.cross(a) / 6;
  result.scaled.col(3) = a.cross(b) / 6;
  result.scaled.col(0) = -result.scaled.rightCols<3>().rowwise().sum();
  result.volume = a.dot(b.cross(c)) / 6;
  return result;
}

} // namespace

Sparse harmonicWeights(const Tetrahedra& mesh)
{
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(16 * mesh.cells.size());
  for (std::size_t t = 0; t < mesh.cells.size(); ++t)
  {
    const ShapeGradients g = shapeGradients(mesh, t);
    const Eigen::Matrix4d local = g.scaled.transpose() * g.scaled / g.volume;
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j) entries.emplace_back(mesh.cells[t][i], mesh.cells[t][j], local(i, j));
    }
  }
  Sparse weights(mesh.points.cols(), mesh.points.cols());
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

Points gradientOf(const Tetrahedra& mesh, const VectorXd& field)
{
  Points gradient(3, Eigen::Index(mesh.cells.size()));
  for (std::size_t t = 0; t < mesh.cells.size(); ++t)
  {
    const ShapeGradients g = shapeGradients(mesh, t);
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < 4; ++i) sum += field[mesh.cells[t][i]] * g.scaled.col(i);
    gradient.col(Eigen::Index(t)) = sum / g.volume;
  }
  return gradient;
}

Points orthogonalised(const Points& gradient, const Points& other)
{
  Points result = gradient;
  for (Eigen::Index t = 0; t < gradient.cols(); ++t)
  {
    const double squared = other.col(t).squaredNorm();
    if (squared > 0) result.col(t) -= other.col(t) * (gradient.col(t).dot(other.col(t)) / squared);
  }
  return result;
}

FieldSolver::FieldSolver(const Tetrahedra& mesh, std::vector<char> known)
  : m_Mesh(mesh), m_Known(std::move(known)), m_Row(m_Known.size(), -1), m_Weights(harmonicWeights(mesh))
{
  std::int32_t unknowns = 0;
  for (std::size_t i = 0; i < m_Known.size(); ++i)
  {
    if (!m_Known[i]) m_Row[i] = unknowns++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < m_Weights.outerSize(); ++column)
  {
    for (Sparse::InnerIterator entry(m_Weights, column); entry; ++entry)
    {
      if (m_Row[entry.row()] >= 0 && m_Row[column] >= 0)
        entries.emplace_back(m_Row[entry.row()], m_Row[column], entry.value());
    }
  }
  Sparse reduced(unknowns, unknowns);
  reduced.setFromTriplets(entries.begin(), entries.end());
  m_Factor.compute(reduced);
  if (m_Factor.info() != Eigen::Success)
    throw EngineError("harmonic field: the equations have no solution; is the body in one piece?");
}

VectorXd FieldSolver::harmonic(const VectorXd& values) const { return solve(values, VectorXd::Zero(values.size())); }

VectorXd FieldSolver::restored(const Points& gradient, const VectorXd& values) const
{
  VectorXd divergence = VectorXd::Zero(values.size());
  for (std::size_t t = 0; t < m_Mesh.cells.size(); ++t)
  {
    const ShapeGradients g = shapeGradients(m_Mesh, t);
    for (int i = 0; i < 4; ++i) divergence[m_Mesh.cells[t][i]] += g.scaled.col(i).dot(gradient.col(Eigen::Index(t)));
  }
  return solve(values, divergence);
}

VectorXd FieldSolver::solve(const VectorXd& values, const VectorXd& divergence) const
{
  VectorXd field = values;
  for (std::size_t i = 0; i < m_Known.size(); ++i)
  {
    if (!m_Known[i]) field[Eigen::Index(i)] = 0;
  }
  const VectorXd full = divergence - m_Weights * field;
  VectorXd right(m_Factor.rows());
  for (std::size_t i = 0; i < m_Row.size(); ++i)
  {
    if (m_Row[i] >= 0) right[m_Row[i]] = full[Eigen::Index(i)];
  }
  const VectorXd solution = m_Factor.solve(right);
  for (std::size_t i = 0; i < m_Row.size(); ++i)
  {
    if (m_Row[i] >= 0) field[Eigen::Index(i)] = solution[m_Row[i]];
  }
  return field;
}

} // namespace surgicalmesher
