// SPDX-License-Identifier: Apache-2.0
#include "Grasp.h"

#include <algorithm>

namespace surgicalmesher
{

Hold holdNear(const Part& part, const Eigen::VectorXd& displacement, const Vec3& tip, double radius, double reach,
              std::size_t most)
{
  std::vector<std::pair<double, std::int32_t>> byDistance;
  for (std::int32_t p = 0; p < std::int32_t(part.points.size()); ++p)
    if (part.body.unknowns[std::size_t(p)] >= 0)
      byDistance.emplace_back(norm(displacedPoint(part, displacement, p) - tip), p);
  std::sort(byDistance.begin(), byDistance.end());
  Hold hold;
  for (const auto& [distance, point] : byDistance)
  {
    const bool isFirst = hold.empty();
    if (isFirst ? distance > reach : distance > radius || hold.size() == most) break;
    hold.push_back(point);
  }
  std::sort(hold.begin(), hold.end());
  return hold;
}

Vec3 displacedPoint(const Part& part, const Eigen::VectorXd& displacement, std::int32_t point)
{
  const Eigen::Vector3d u = displacement.segment<3>(3 * part.body.unknowns[std::size_t(point)]);
  return part.body.mesh.points[std::size_t(point)] + Vec3{ u[0], u[1], u[2] };
}

std::vector<std::int32_t> unknownsOf(const ElasticBody& body, const Hold& hold)
{
  std::vector<std::int32_t> result;
  for (const std::int32_t point : hold)
    for (std::int32_t i = 0; i < 3; ++i) result.push_back(3 * body.unknowns[std::size_t(point)] + i);
  return result;
}

Vec3 totalOf(const Eigen::VectorXd& forces)
{
  const Eigen::Vector3d sum = Eigen::Map<const Eigen::Matrix3Xd>(forces.data(), 3, forces.size() / 3).rowwise().sum();
  return { sum[0], sum[1], sum[2] };
}

Grasp::Grasp(const LinearChild& child, const Hold& hold, double stiffness)
  : m_Unknowns(unknownsOf(child.part().body, hold)), m_Compliance(child.compliance(m_Unknowns)),
    m_Start(child.atRest()(m_Unknowns))
{
  Eigen::MatrixXd series = m_Compliance(m_Unknowns, Eigen::all);
  series.diagonal().array() += double(hold.size()) / stiffness;
  m_SpringsInSeries.compute(series);
}

Eigen::VectorXd Grasp::forces(const LinearChild& child, const Vec3& motion) const
{
  const Eigen::Vector3d moved(motion.x, motion.y, motion.z);
  const Eigen::VectorXd stretch =
    m_Start + moved.replicate(Eigen::Index(m_Unknowns.size()) / 3, 1) - child.atRest()(m_Unknowns);
  return m_SpringsInSeries.solve(stretch);
}

Eigen::VectorXd Grasp::displacement(const LinearChild& child, const Eigen::VectorXd& forces) const
{
  Eigen::VectorXd result = child.atRest();
  result.noalias() += m_Compliance * forces;
  return result;
}

} // namespace surgicalmesher
