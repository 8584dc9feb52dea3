// SPDX-License-Identifier: Apache-2.0
#include "ThinPlateSpline.h"

#include "Errors.h"
#include "Parallel.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

/// Matrix of the spline's equations: kernel and affine part, and the rows that make the weights orthogonal to affine
/// maps.
Eigen::MatrixXd systemOf(const Points& centres)
{
  const Eigen::Index n = centres.cols();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
  for (Eigen::Index i = 0; i < n; ++i)
    system.col(i).head(n) = (centres.colwise() - centres.col(i)).colwise().norm().transpose();
  system.block(n, 0, 3, n) = centres;
  system.row(n + 3).head(n).setOnes();
  system.topRightCorner(n, 4) = system.bottomLeftCorner(4, n).transpose();
  return system;
}

Eigen::MatrixXd rightSideOf(const Points& goals)
{
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(goals.cols() + 4, 3);
  right.topRows(goals.cols()) = goals.transpose();
  return right;
}

} // namespace

ThinPlateSpline::ThinPlateSpline(const Points& centres, const Points& goals)
  : m_Middle(centres.rowwise().mean()),
    m_Size(std::sqrt((centres.colwise() - m_Middle).colwise().squaredNorm().maxCoeff()))
{
  const Eigen::Index n = centres.cols();
  m_Centres = (centres.colwise() - m_Middle) / m_Size;
  const Eigen::MatrixXd system = systemOf(m_Centres), right = rightSideOf(goals);
  const Eigen::MatrixXd solution = system.partialPivLu().solve(right);
  if (!solution.allFinite() || (system * solution - right).norm() > 1e-6 * (1 + right.norm()))
    throw EngineError("thin-plate spline: the equations of " + std::to_string(n) + " centres have no solution");
  m_Weights = solution.topRows(n).transpose();
  m_Affine = solution.bottomRows(4).transpose();
}

Points ThinPlateSpline::operator()(const Points& points) const
{
  Points moved(3, points.cols());
  parallelFor(std::size_t(points.cols()),
              [&](std::size_t i)
              {
                const Eigen::Vector3d p = (points.col(Eigen::Index(i)) - m_Middle) / m_Size;
                const Eigen::VectorXd kernel = (m_Centres.colwise() - p).colwise().norm().transpose();
                moved.col(Eigen::Index(i)) = m_Affine * p.homogeneous() + m_Weights * kernel;
              });
  return moved;
}

std::vector<double> leftOutErrors(const Points& centres, const Points& goals)
{
  const Eigen::Vector3d middle = centres.rowwise().mean();
  const double size = std::sqrt((centres.colwise() - middle).colwise().squaredNorm().maxCoeff());
  const Eigen::MatrixXd inverse = systemOf((centres.colwise() - middle) / size).inverse();
  const Eigen::MatrixXd solution = inverse * rightSideOf(goals);
  std::vector<double> errors;
  for (Eigen::Index i = 0; i < centres.cols(); ++i)
  {
    const double own = std::abs(inverse(i, i));
    errors.push_back(own > 1e-9 ? solution.row(i).norm() / own : std::numeric_limits<double>::infinity());
  }
  return errors;
}

std::vector<std::int32_t> farthestPoints(const Points& points, int count)
{
  const Eigen::Index wanted = std::min<Eigen::Index>(count, points.cols());
  std::vector<std::int32_t> chosen;
  if (wanted == 0) return chosen;
  const Eigen::Vector3d middle = points.rowwise().mean();
  Eigen::RowVectorXd squared = (points.colwise() - middle).colwise().squaredNorm();
  Eigen::Index farthest = 0;
  squared.maxCoeff(&farthest);
  squared.setConstant(std::numeric_limits<double>::infinity());
  while (Eigen::Index(chosen.size()) < wanted)
  {
    chosen.push_back(std::int32_t(farthest));
    const Eigen::Vector3d latest = points.col(farthest);
    squared = squared.cwiseMin((points.colwise() - latest).colwise().squaredNorm());
    if (squared.maxCoeff(&farthest) <= 0) break;
  }
  return chosen;
}

} // namespace surgicalmesher
