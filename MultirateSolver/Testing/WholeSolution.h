// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The whole mesh solved at once, to compare coupled parts with.

#include "CoupledParts.h"
#include "Errors.h"
#include "SparseCholesky.h"

#include <cmath>

namespace surgicalmesher::test
{

/// A spring from a point of the whole to a displacement.
struct PointSpring
{
  std::int32_t point = 0;
  double stiffness = 0; ///< N/mm
  Vec3 pull;            ///< mm
};

/// The whole with the tetrahedra of one child alone, or with all others.
inline ElasticBody reduced(const CoupledMesh& mesh, std::int32_t child, bool toChild)
{
  ElasticBody body = mesh.whole;
  body.mesh.tetrahedra.clear();
  body.mesh.labels.clear();
  body.lame.clear();
  for (std::size_t t = 0; t < mesh.part.size(); ++t)
  {
    if ((mesh.part[t] == child) != toChild) continue;
    body.mesh.tetrahedra.push_back(mesh.whole.mesh.tetrahedra[t]);
    body.mesh.labels.push_back(mesh.whole.mesh.labels[t]);
    body.lame.push_back(mesh.whole.lame[t]);
  }
  return body;
}

class WholeSolution
{
public:
  /// Linear, but for one child that is neo-Hookean; 0: none is.
  WholeSolution(const CoupledMesh& mesh, const Vec3& weight, std::int32_t neoHookeanChild)
    : m_Mesh(mesh), m_NeoHookean(neoHookeanChild > 0),
      m_Linear(linearStiffness(m_NeoHookean ? reduced(mesh, neoHookeanChild, false) : mesh.whole)),
      m_Child(reduced(mesh, neoHookeanChild, true)), m_Weight(weightOf(mesh.whole, weight)),
      m_Displacement(Eigen::VectorXd::Zero(mesh.whole.size()))
  {
  }

  /// Newton's method with steps halved until the energy falls, from the last solution; the residual is at most 1e-10 of
  /// the largest force.
  const Eigen::VectorXd& solve(const std::vector<PointSpring>& springs)
  {
    for (int iteration = 0; iteration < 50; ++iteration)
    {
      Eigen::VectorXd inner = m_Linear.selfadjointView<Eigen::Lower>() * m_Displacement, outer = m_Weight;
      if (m_NeoHookean) inner += NeoHookean::forces(m_Child, m_Displacement);
      for (const PointSpring& spring : springs)
      {
        for (int i = 0; i < 3; ++i)
        {
          const Eigen::Index u = 3 * m_Mesh.whole.unknowns[std::size_t(spring.point)] + i;
          outer[u] += spring.stiffness * (spring.pull[i] - m_Displacement[u]);
        }
      }
      const Eigen::VectorXd residual = outer - inner;
      if (residual.lpNorm<Eigen::Infinity>() <= 1e-10 * inner.lpNorm<Eigen::Infinity>()) return m_Displacement;
      Eigen::VectorXd step = newtonStep(residual, springs);
      const double before = energy(m_Displacement, springs), rounding = 1e-12 * std::abs(before);
      for (int k = 0; k < 40 && !(energy(m_Displacement + step, springs) <= before + rounding); ++k) step /= 2;
      m_Displacement += step;
    }
    throw EngineError("the whole mesh does not settle");
  }

  Vec3 at(std::size_t point) const
  {
    const Eigen::Index u = 3 * m_Mesh.whole.unknowns[point];
    return u < 0 ? Vec3{ 0, 0, 0 } : Vec3{ m_Displacement[u], m_Displacement[u + 1], m_Displacement[u + 2] };
  }

  /// Of displacements of a part's points, or of all, relative to the largest one.
  double errorOf(const std::vector<Vec3>& displacements, std::int32_t part = -1) const
  {
    double error = 0, largest = 0;
    for (std::size_t t = 0; t < m_Mesh.part.size(); ++t)
    {
      if (part >= 0 && m_Mesh.part[t] != part) continue;
      for (const std::int32_t corner : m_Mesh.whole.mesh.tetrahedra[t])
      {
        const auto p = std::size_t(corner);
        error = std::max(error, norm(displacements[p] - at(p)));
        largest = std::max(largest, norm(at(p)));
      }
    }
    return error / largest;
  }

private:
  double energy(const Eigen::VectorXd& displacement, const std::vector<PointSpring>& springs) const
  {
    const Eigen::VectorXd inner = m_Linear.selfadjointView<Eigen::Lower>() * displacement;
    double sum = 0.5 * displacement.dot(inner) - m_Weight.dot(displacement);
    if (m_NeoHookean) sum += NeoHookean::energy(m_Child, displacement);
    for (const PointSpring& spring : springs)
      for (int i = 0; i < 3; ++i)
      {
        const Eigen::Index u = 3 * m_Mesh.whole.unknowns[std::size_t(spring.point)] + i;
        sum += 0.5 * spring.stiffness * (spring.pull[i] - displacement[u]) * (spring.pull[i] - displacement[u]);
      }
    return sum;
  }

  /// With each tetrahedron's tangent made definite where the whole one is not.
  Eigen::VectorXd newtonStep(const Eigen::VectorXd& residual, const std::vector<PointSpring>& springs) const
  {
    for (const bool definite : { false, true })
    {
      SymmetricMatrix tangent = m_Linear;
      if (m_NeoHookean) tangent += NeoHookean::tangent(m_Child, m_Displacement, definite);
      for (const PointSpring& spring : springs)
        for (int i = 0; i < 3; ++i)
        {
          const Eigen::Index u = 3 * m_Mesh.whole.unknowns[std::size_t(spring.point)] + i;
          tangent.coeffRef(u, u) += spring.stiffness;
        }
      SparseCholesky factor(tangent);
      if (factor.factorize(tangent)) return factor.solve(residual);
    }
    throw EngineError("the whole mesh's equations are singular");
  }

  const CoupledMesh& m_Mesh;
  bool m_NeoHookean;
  SymmetricMatrix m_Linear;
  ElasticBody m_Child;
  Eigen::VectorXd m_Weight, m_Displacement;
};

} // namespace surgicalmesher::test
