// SPDX-License-Identifier: Apache-2.0
#include "LinearChild.h"

#include "Errors.h"

namespace surgicalmesher
{

SymmetricMatrix withDenseBlock(const SymmetricMatrix& matrix, const Eigen::MatrixXd& dense,
                               const std::vector<std::int32_t>& at)
{
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(at.size() * (at.size() + 1) / 2);
  for (std::size_t c = 0; c < at.size(); ++c)
    for (std::size_t r = c; r < at.size(); ++r)
      entries.emplace_back(std::max(at[r], at[c]), std::min(at[r], at[c]), dense(Eigen::Index(r), Eigen::Index(c)));
  SymmetricMatrix block(matrix.rows(), matrix.cols());
  block.setFromTriplets(entries.begin(), entries.end());
  return matrix + block;
}

LinearChild::LinearChild(Part part, std::vector<std::int32_t> interface, const NortonEquivalent& norton,
                         Eigen::VectorXd forces)
  : m_Part(std::move(part)), m_Interface(std::move(interface)),
    m_Factor(withDenseBlock(linearStiffness(m_Part.body), norton.stiffness, m_Interface), m_Interface),
    m_Forces(std::move(forces))
{
  if (!m_Factor.factorize(withDenseBlock(linearStiffness(m_Part.body), norton.stiffness, m_Interface)))
    throw InputError("the child's equations are singular, expected a child that touches what is around it");
  setNortonForce(norton.force);
}

void LinearChild::setNortonForce(const Eigen::VectorXd& force)
{
  Eigen::VectorXd forces = m_Forces;
  forces(m_Interface) += force;
  m_AtRest = response(forces);
}

Eigen::MatrixXd LinearChild::compliance(const std::vector<std::int32_t>& unknowns) const
{
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(m_Part.body.size(), Eigen::Index(unknowns.size()));
  for (std::size_t k = 0; k < unknowns.size(); ++k) forces(unknowns[k], Eigen::Index(k)) = 1;
  return response(forces);
}

} // namespace surgicalmesher
