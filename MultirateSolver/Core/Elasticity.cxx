// SPDX-License-Identifier: Apache-2.0
#include "Elasticity.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

using ElementMatrix = Eigen::Matrix<double, 12, 12>;
using Gradients = Eigen::Matrix<double, 3, 4>; ///< a column for each corner

struct Element
{
  Gradients gradients;
  double volume = 0;
};

Element elementOf(const TetMesh& mesh, std::size_t t)
{
  const LinearTetrahedron tetrahedron = linearTetrahedron(cornersOf(mesh, t));
  Element element;
  element.volume = tetrahedron.volume;
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i) element.gradients(i, a) = tetrahedron.gradients[a][i];
  return element;
}

Eigen::Matrix3d deformationGradient(const ElasticBody& body, std::size_t t, const Element& element,
                                    const Eigen::VectorXd& displacement)
{
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  for (int a = 0; a < 4; ++a)
  {
    const std::int32_t row = body.unknowns[body.mesh.tetrahedra[t][a]];
    if (row >= 0) result += displacement.segment<3>(3 * row) * element.gradients.col(a).transpose();
  }
  return result;
}

/// Element tangent of the neo-Hookean law at deformation gradient F: with h_a = F^-T g_a, block (a, b) is V (mu g_a.g_b
/// I + lambda h_a h_b' + (mu - lambda ln J) h_b h_a').
ElementMatrix elementTangent(const Element& element, const LameConstants& lame, const Eigen::Matrix3d& F)
{
  const Gradients h = F.inverse().transpose() * element.gradients;
  const double turning = lame.mu - lame.lambda * std::log(F.determinant());
  ElementMatrix matrix;
  for (int a = 0; a < 4; ++a)
  {
    for (int b = 0; b < 4; ++b)
    {
      matrix.block<3, 3>(3 * a, 3 * b) =
        element.volume *
        (lame.mu * element.gradients.col(a).dot(element.gradients.col(b)) * Eigen::Matrix3d::Identity() +
         lame.lambda * h.col(a) * h.col(b).transpose() + turning * h.col(b) * h.col(a).transpose());
    }
  }
  return matrix;
}

ElementMatrix withoutNegativeEigenvalues(const ElementMatrix& matrix)
{
  const Eigen::SelfAdjointEigenSolver<ElementMatrix> modes(matrix);
  return modes.eigenvectors() * modes.eigenvalues().cwiseMax(0).asDiagonal() * modes.eigenvectors().transpose();
}

template <class MatrixOfElement>
SymmetricMatrix assemble(const ElasticBody& body, const MatrixOfElement& matrixOfElement)
{
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(78 * body.mesh.tetrahedra.size());
  for (std::size_t t = 0; t < body.mesh.tetrahedra.size(); ++t)
  {
    const ElementMatrix matrix = matrixOfElement(t);
    std::array<std::int32_t, 12> rows;
    for (int r = 0; r < 12; ++r)
    {
      const std::int32_t point = body.unknowns[body.mesh.tetrahedra[t][r / 3]];
      rows[r] = point < 0 ? -1 : 3 * point + r % 3;
    }
    for (int r = 0; r < 12; ++r)
    {
      for (int c = 0; c < 12; ++c)
        if (rows[c] >= 0 && rows[r] >= rows[c]) entries.emplace_back(rows[r], rows[c], matrix(r, c));
    }
  }
  SymmetricMatrix result(body.size(), body.size());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

} // namespace

SymmetricMatrix linearStiffness(const ElasticBody& body)
{
  return assemble(body, [&](std::size_t t)
                  { return elementTangent(elementOf(body.mesh, t), body.lame[t], Eigen::Matrix3d::Identity()); });
}

Eigen::VectorXd weightOf(const ElasticBody& body, const Vec3& forcePerVolume)
{
  Eigen::VectorXd result = Eigen::VectorXd::Zero(body.size());
  for (std::size_t t = 0; t < body.mesh.tetrahedra.size(); ++t)
  {
    const double share = linearTetrahedron(cornersOf(body.mesh, t)).volume / 4;
    for (const std::int32_t point : body.mesh.tetrahedra[t])
    {
      const std::int32_t row = body.unknowns[point];
      for (int i = 0; i < 3 && row >= 0; ++i) result[3 * row + i] += share * forcePerVolume[i];
    }
  }
  return result;
}

double NeoHookean::energy(const ElasticBody& body, const Eigen::VectorXd& displacement)
{
  double sum = 0;
  for (std::size_t t = 0; t < body.mesh.tetrahedra.size(); ++t)
  {
    const Element element = elementOf(body.mesh, t);
    const Eigen::Matrix3d F = deformationGradient(body, t, element, displacement);
    const double J = F.determinant();
    if (!(J > 0)) return std::numeric_limits<double>::infinity();
    const auto [lambda, mu] = body.lame[t];
    const double lnJ = std::log(J);
    sum += element.volume * (mu / 2 * (F.squaredNorm() - 3) - mu * lnJ + lambda / 2 * lnJ * lnJ);
  }
  return sum;
}

Eigen::VectorXd NeoHookean::forces(const ElasticBody& body, const Eigen::VectorXd& displacement)
{
  Eigen::VectorXd result = Eigen::VectorXd::Zero(body.size());
  for (std::size_t t = 0; t < body.mesh.tetrahedra.size(); ++t)
  {
    const Element element = elementOf(body.mesh, t);
    const Eigen::Matrix3d F = deformationGradient(body, t, element, displacement);
    const auto [lambda, mu] = body.lame[t];
    const Eigen::Matrix3d inverse = F.inverse().transpose();
    const Eigen::Matrix3d stress = mu * (F - inverse) + lambda * std::log(F.determinant()) * inverse;
    for (int a = 0; a < 4; ++a)
    {
      const std::int32_t row = body.unknowns[body.mesh.tetrahedra[t][a]];
      if (row >= 0) result.segment<3>(3 * row) += element.volume * stress * element.gradients.col(a);
    }
  }
  return result;
}

SymmetricMatrix NeoHookean::tangent(const ElasticBody& body, const Eigen::VectorXd& displacement, bool definite)
{
  return assemble(body,
                  [&](std::size_t t)
                  {
                    const Element element = elementOf(body.mesh, t);
                    const ElementMatrix matrix =
                      elementTangent(element, body.lame[t], deformationGradient(body, t, element, displacement));
                    return definite ? withoutNegativeEigenvalues(matrix) : matrix;
                  });
}

} // namespace surgicalmesher
