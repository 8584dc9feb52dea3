// SPDX-License-Identifier: Apache-2.0
#include "Carrying.h"

#include "Parallel.h"
#include "ThinPlateSpline.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

namespace surgicalmesher
{
namespace
{

/// Mean residual of the eight nodes closest to the point, weighted by inverse squared distance.
Eigen::Vector3d nearResidual(const Eigen::Vector3d& point, const Points& nodes, const Points& residual,
                             vtkStaticPointLocator* locator)
{
  vtkNew<vtkIdList> near;
  locator->FindClosestNPoints(8, point.data(), near);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0;
  for (vtkIdType k = 0; k < near->GetNumberOfIds(); ++k)
  {
    const vtkIdType node = near->GetId(k);
    const double weight = 1 / (1e-12 + (nodes.col(node) - point).squaredNorm());
    sum += weight * residual.col(node);
    weights += weight;
  }
  return sum / weights;
}

} // namespace

Points carried(const Points& points, const Points& from, const Points& to, int centres)
{
  const std::vector<std::int32_t> chosen = farthestPoints(from, centres);
  const ThinPlateSpline spline(from(Eigen::all, chosen), to(Eigen::all, chosen));
  const Points residual = to - spline(from);
  vtkNew<vtkPoints> nodes;
  nodes->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < from.cols(); ++i) nodes->InsertNextPoint(from.col(i).data());
  vtkNew<vtkPolyData> data;
  data->SetPoints(nodes);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  Points moved = spline(points);
  parallelFor(std::size_t(points.cols()), [&](std::size_t i)
              { moved.col(Eigen::Index(i)) += nearResidual(points.col(Eigen::Index(i)), from, residual, locator); });
  return moved;
}

} // namespace surgicalmesher
