// SPDX-License-Identifier: Apache-2.0
#include "Surroundings.h"

#include "Errors.h"

namespace surgicalmesher
{
namespace
{

double meanDiagonal(const SymmetricMatrix& matrix) { return matrix.rows() > 0 ? matrix.diagonal().mean() : 0; }

SymmetricMatrix withSprings(SymmetricMatrix matrix, const std::vector<std::int32_t>& at, double spring)
{
  for (const std::int32_t u : at) matrix.coeffRef(u, u) += spring;
  return matrix;
}

} // namespace

// A piece beyond a child that goes right across the body hangs on the child alone: without the child it would float.
// Springs at the interface hold it, and are subtracted from the stiffness that the child feels.
Surroundings::Surroundings(Part part, std::vector<std::int32_t> interface)
  : m_Part(std::move(part)), m_Interface(std::move(interface)), m_Spring(meanDiagonal(linearStiffness(m_Part.body))),
    m_Factor(linearStiffness(m_Part.body), m_Interface)
{
  if (!m_Factor.factorize(withSprings(linearStiffness(m_Part.body), m_Interface, m_Spring)))
    throw InputError(
      "the equations around a child are singular: a piece hangs on nothing held and on no child, expected one body");
  m_Norton.stiffness = m_Factor.condensed();
  m_Norton.stiffness.diagonal().array() -= m_Spring;
  load(Eigen::VectorXd::Zero(m_Part.body.size()));
}

void Surroundings::load(const Eigen::VectorXd& forces)
{
  m_Forces = forces;
  // Without the child, the displacement w of the interface on its springs k satisfies (S + k) w = g.
  const Eigen::VectorXd w = m_Factor.solve(forces).col(0)(m_Interface);
  m_Norton.force = m_Norton.stiffness * w + m_Spring * w;
}

Eigen::VectorXd Surroundings::displacement(const Eigen::VectorXd& interface) const
{
  Eigen::VectorXd forces = m_Forces;
  // Of the child, and against the springs.
  forces(m_Interface) += m_Norton.stiffness * interface + m_Spring * interface - m_Norton.force;
  return m_Factor.solve(forces);
}

} // namespace surgicalmesher
