// SPDX-License-Identifier: Apache-2.0
#include "ChartMap.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <map>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;
using Loop = std::vector<std::int32_t>;

/// Chains the border edges, each of a single triangle, into loops with the winding of the triangles.
std::vector<Loop> borderLoops(const std::vector<Triangle>& triangles)
{
  std::map<std::array<std::int32_t, 2>, int> seen;
  for (const Triangle& t : triangles)
  {
    for (int i = 0; i < 3; ++i) ++seen[{ t[i], t[(i + 1) % 3] }];
  }
  std::multimap<std::int32_t, std::int32_t> next;
  for (const auto& [edge, count] : seen)
  {
    if (!seen.count({ edge[1], edge[0] })) next.emplace(edge[0], edge[1]);
  }
  std::vector<Loop> loops;
  while (!next.empty())
  {
    Loop loop;
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back()))
    {
      loop.push_back(at->second);
      next.erase(at);
    }
    loops.push_back(loop);
  }
  return loops;
}

/// Area of the bounding box of a loop's coordinates; it is largest for the outer border of the chart.
double boxArea(const Loop& loop, const Eigen::Matrix2Xd& coordinates)
{
  Vector2d low = coordinates.col(loop.front()), high = low;
  for (const std::int32_t id : loop)
  {
    low = low.cwiseMin(coordinates.col(id));
    high = high.cwiseMax(coordinates.col(id));
  }
  return (high - low).prod();
}

std::vector<Loop> holesOf(const Chart& chart)
{
  std::vector<Loop> loops = borderLoops(chart.surface.triangles);
  const auto outermost = std::max_element(loops.begin(), loops.end(),
                                          [&](const Loop& a, const Loop& b)
                                          { return boxArea(a, chart.coordinates) < boxArea(b, chart.coordinates); });
  if (outermost != loops.end()) loops.erase(outermost);
  return loops;
}

void addFan(const Loop& loop, Chart& chart)
{
  const auto middle = std::int32_t(chart.surface.points.cols());
  Vector3d position = Vector3d::Zero();
  Vector2d coordinates = Vector2d::Zero();
  for (const std::int32_t id : loop)
  {
    position += chart.surface.points.col(id) / double(loop.size());
    coordinates += chart.coordinates.col(id) / double(loop.size());
  }
  chart.surface.points.conservativeResize(Eigen::NoChange, middle + 1);
  chart.coordinates.conservativeResize(Eigen::NoChange, middle + 1);
  chart.surface.points.col(middle) = position;
  chart.coordinates.col(middle) = coordinates;
  for (std::size_t i = 0; i < loop.size(); ++i)
    chart.surface.triangles.push_back({ loop[(i + 1) % loop.size()], loop[i], middle });
}

vtkSmartPointer<vtkStaticCellLocator> flatLocator(const Chart& chart)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < chart.coordinates.cols(); ++i)
    points->InsertNextPoint(chart.coordinates(0, i), chart.coordinates(1, i), 0);
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : chart.surface.triangles)
  {
    const vtkIdType ids[3] = { t[0], t[1], t[2] };
    cells->InsertNextCell(3, ids);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->BuildCells();
  auto locator = vtkSmartPointer<vtkStaticCellLocator>::New();
  locator->SetDataSet(data);
  locator->BuildLocator();
  return locator;
}

/// Barycentric coordinates of `p` in a triangle of the plane; a third each in one without area.
Vector3d barycentric(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& p)
{
  const Vector2d ab = b - a, ac = c - a, ap = p - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  if (area == 0) return Vector3d::Constant(1. / 3);
  const double v = (ap.x() * ac.y() - ap.y() * ac.x()) / area, w = (ab.x() * ap.y() - ab.y() * ap.x()) / area;
  return { 1 - v - w, v, w };
}

} // namespace

ChartMap::ChartMap(const Chart& chart) : m_Chart(chart), m_Real(chart.surface.triangles.size())
{
  for (const Loop& loop : holesOf(chart))
  {
    addFan(loop, m_Chart);
    m_Holes.emplace_back();
    for (const std::int32_t id : loop) m_Holes.back().emplace_back(chart.surface.points.col(id));
  }
  m_Locator = flatLocator(m_Chart);
}

ChartMap::Place ChartMap::at(const Vector2d& coordinates) const
{
  const double point[3] = { coordinates.x(), coordinates.y(), 0 };
  double closest[3], squared = 0;
  vtkIdType cell = 0;
  int subId = 0;
  vtkNew<vtkGenericCell> scratch;
  m_Locator->FindClosestPoint(point, closest, scratch, cell, subId, squared);
  const Triangle& t = m_Chart.surface.triangles[std::size_t(cell)];
  const Vector3d weights = barycentric(m_Chart.coordinates.col(t[0]), m_Chart.coordinates.col(t[1]),
                                       m_Chart.coordinates.col(t[2]), { closest[0], closest[1] });
  const Vector3d position = weights[0] * m_Chart.surface.points.col(t[0]) +
                            weights[1] * m_Chart.surface.points.col(t[1]) +
                            weights[2] * m_Chart.surface.points.col(t[2]);
  return { position, std::size_t(cell) >= m_Real };
}

} // namespace surgicalmesher
