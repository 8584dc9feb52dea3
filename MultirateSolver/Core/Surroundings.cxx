// SPDX-License-Identifier: Apache-2.0
#include "Surroundings.h"

#include "Errors.h"

namespace surgicalmesher
{

Surroundings::Surroundings(Part part, std::vector<std::int32_t> interface)
  : m_Part(std::move(part)), m_Interface(std::move(interface)), m_Factor(linearStiffness(m_Part.body), m_Interface)
{
  if (!m_Factor.factorize(linearStiffness(m_Part.body)))
    throw InputError("the equations around a child are singular: a piece hangs on no held point, expected one body");
  m_Norton.stiffness = m_Factor.condensed();
  load(Eigen::VectorXd::Zero(m_Part.body.size()));
}

void Surroundings::load(const Eigen::VectorXd& forces)
{
  m_Forces = forces;
  // Without the child, the displacement w of the interface satisfies S w = g.
  m_Norton.force = m_Norton.stiffness * m_Factor.solve(forces).col(0)(m_Interface);
}

Eigen::VectorXd Surroundings::displacement(const Eigen::VectorXd& interface) const
{
  Eigen::VectorXd forces = m_Forces;
  forces(m_Interface) += m_Norton.stiffness * interface - m_Norton.force; // force of the child on the surroundings
  return m_Factor.solve(forces);
}

} // namespace surgicalmesher
