// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Inverse of a surface's parameterisation: from coordinates to points.

#include "SlabParameterisation.h"

#include <vtkSmartPointer.h>

class vtkStaticCellLocator;

namespace surgicalmesher
{

/// Maps the coordinates of a chart to points of its surface. Each hole of the chart is closed by a fan of triangles
/// around the mean of its border points.
class ChartMap
{
public:
  explicit ChartMap(const Chart& chart);

  struct Place
  {
    Eigen::Vector3d position; ///< mm
    bool inHole;
  };

  /// Returns the point at (u, w), by the triangle of the chart there or else the nearest one.
  Place at(const Eigen::Vector2d& coordinates) const;

  /// Borders of the chart's holes as closed loops of positions; the first position is not repeated at the end.
  const std::vector<std::vector<Eigen::Vector3d>>& holes() const { return m_Holes; }

private:
  Chart m_Chart;      ///< with the fans
  std::size_t m_Real; ///< number of triangles without the fans, which come last
  std::vector<std::vector<Eigen::Vector3d>> m_Holes;
  vtkSmartPointer<vtkStaticCellLocator> m_Locator;
};

} // namespace surgicalmesher
