// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From coordinates on a surface back to its points.

#include "SlabParameterisation.h"

#include <vtkSmartPointer.h>

class vtkStaticCellLocator;

namespace surgicalmesher
{

/// The inverse of a chart's coordinates. Holes of the chart are closed by a fan of triangles around their middle.
class ChartMap
{
public:
  explicit ChartMap(const Chart& chart);

  struct Place
  {
    Eigen::Vector3d position; ///< mm
    bool inHole;
  };

  /// By the triangle at (u, w), or the one next to it.
  Place at(const Eigen::Vector2d& coordinates) const;

  /// Borders of the chart's holes as closed loops of positions, the first not repeated.
  const std::vector<std::vector<Eigen::Vector3d>>& holes() const { return m_Holes; }

private:
  Chart m_Chart;      ///< with the fans
  std::size_t m_Real; ///< number of triangles before them
  std::vector<std::vector<Eigen::Vector3d>> m_Holes;
  vtkSmartPointer<vtkStaticCellLocator> m_Locator;
};

} // namespace surgicalmesher
