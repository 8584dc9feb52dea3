// SPDX-License-Identifier: Apache-2.0
#include "NeoHookeanChild.h"

#include "Errors.h"

#include <algorithm>

namespace surgicalmesher
{

struct NeoHookeanChild::Springs
{
  std::vector<std::int32_t> unknowns;
  Eigen::VectorXd pull;
  double each = 0; ///< N/mm
};

NeoHookeanChild::NeoHookeanChild(Part part, std::vector<std::int32_t> interface, NortonEquivalent norton,
                                 Eigen::VectorXd forces)
  : m_Part(std::move(part)), m_Interface(std::move(interface)), m_Norton(std::move(norton)),
    m_Forces(std::move(forces)), m_Displacement(Eigen::VectorXd::Zero(m_Part.body.size())),
    m_Factor(withDenseBlock(linearStiffness(m_Part.body), m_Norton.stiffness, m_Interface), m_Interface)
{
}

double NeoHookeanChild::energy(const Eigen::VectorXd& displacement, const Springs& springs) const
{
  const Eigen::VectorXd interface = displacement(m_Interface);
  double sum = NeoHookean::energy(m_Part.body, displacement) - m_Forces.dot(displacement) +
               interface.dot(0.5 * (m_Norton.stiffness * interface) - m_Norton.force);
  if (!springs.unknowns.empty())
    sum += 0.5 * springs.each * (displacement(springs.unknowns) - springs.pull).squaredNorm();
  return sum;
}

Eigen::VectorXd NeoHookeanChild::outerForces(const Eigen::VectorXd& displacement, const Springs& springs) const
{
  Eigen::VectorXd result = m_Forces;
  result(m_Interface) += m_Norton.force - m_Norton.stiffness * displacement(m_Interface);
  if (!springs.unknowns.empty())
    result(springs.unknowns) += springs.each * (springs.pull - displacement(springs.unknowns));
  return result;
}

Eigen::VectorXd NeoHookeanChild::newtonStep(const Eigen::VectorXd& residual, const Springs& springs)
{
  for (const bool definite : { false, true })
  {
    SymmetricMatrix tangent =
      withDenseBlock(NeoHookean::tangent(m_Part.body, m_Displacement, definite), m_Norton.stiffness, m_Interface);
    for (const std::int32_t u : springs.unknowns) tangent.coeffRef(u, u) += springs.each;
    if (m_Factor.factorize(tangent)) return m_Factor.solve(residual);
  }
  throw EngineError("the neo-Hookean child's equations are singular");
}

Convergence NeoHookeanChild::settle(const Hold& hold, const Eigen::VectorXd& pull, double stiffness, double tolerance)
{
  constexpr int kMostIterations = 100, kMostHalvings = 40;
  const Springs springs{ unknownsOf(m_Part.body, hold), pull, hold.empty() ? 0 : stiffness / double(hold.size()) };
  Convergence result;
  for (;; ++result.iterations)
  {
    const Eigen::VectorXd outer = outerForces(m_Displacement, springs);
    const Eigen::VectorXd inner = NeoHookean::forces(m_Part.body, m_Displacement);
    const Eigen::VectorXd residual = outer - inner;
    const double largest = std::max(outer.lpNorm<Eigen::Infinity>(), inner.lpNorm<Eigen::Infinity>());
    result.residual = largest > 0 ? residual.lpNorm<Eigen::Infinity>() / largest : 0;
    if (result.residual <= tolerance) return result;
    if (result.iterations == kMostIterations) break;
    const Eigen::VectorXd step = newtonStep(residual, springs);
    const double before = energy(m_Displacement, springs), slope = residual.dot(step);
    double share = 1;
    // The tolerance covers rounding of the energy, which exceeds the gain of a last, tiny step.
    const double rounding = 1e-12 * std::abs(before);
    for (int k = 0; k < kMostHalvings; ++k, share /= 2)
      if (energy(m_Displacement + share * step, springs) <= before - 1e-4 * share * slope + rounding) break;
    m_Displacement += share * step;
  }
  throw EngineError("the neo-Hookean child does not settle, residual " + std::to_string(result.residual) +
                    " of the largest force after " + std::to_string(kMostIterations) + " steps");
}

Eigen::VectorXd NeoHookeanChild::springForces(const Hold& hold, const Eigen::VectorXd& pull, double stiffness) const
{
  return stiffness / double(hold.size()) * (pull - m_Displacement(unknownsOf(m_Part.body, hold)));
}

} // namespace surgicalmesher
