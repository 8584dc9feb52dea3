// SPDX-License-Identifier: Apache-2.0
#include "ElementQuality.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{
namespace
{

struct LocalCorners
{
  double best;
  std::vector<std::array<int, 4>> corners;
};

const LocalCorners& localCorners(ElementShape shape)
{
  static const LocalCorners none{ 1, {} };
  static const LocalCorners tetrahedron{ std::sqrt(0.5),
                                         { { 0, 1, 2, 3 }, { 1, 2, 0, 3 }, { 2, 0, 1, 3 }, { 3, 0, 2, 1 } } };
  static const LocalCorners wedge{
    std::sqrt(0.75), { { 0, 1, 2, 3 }, { 1, 2, 0, 4 }, { 2, 0, 1, 5 }, { 3, 5, 4, 0 }, { 4, 3, 5, 1 }, { 5, 4, 3, 2 } }
  };
  static const LocalCorners hexahedron{ 1,
                                        { { 0, 1, 3, 4 },
                                          { 1, 2, 0, 5 },
                                          { 2, 3, 1, 6 },
                                          { 3, 0, 2, 7 },
                                          { 4, 7, 5, 0 },
                                          { 5, 4, 6, 1 },
                                          { 6, 5, 7, 2 },
                                          { 7, 6, 4, 3 } } };
  switch (shape)
  {
  case ElementShape::Tetrahedron: return tetrahedron;
  case ElementShape::Wedge: return wedge;
  case ElementShape::Hexahedron: return hexahedron;
  default: return none;
  }
}

/// Jacobian with columns of unit length; a column is zero if its edge has no length.
Eigen::Matrix3d unitJacobian(const Corner& corner, const Points& points)
{
  Eigen::Matrix3d jacobian;
  const std::int32_t ends[3] = { corner.first, corner.second, corner.third };
  for (int i = 0; i < 3; ++i) jacobian.col(i) = (points.col(ends[i]) - points.col(corner.node)).normalized();
  return jacobian;
}

} // namespace

std::vector<Corner> cornersOf(const std::vector<Element>& elements)
{
  std::vector<Corner> corners;
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    const LocalCorners& local = localCorners(elements[e].shape);
    const auto& nodes = elements[e].nodes;
    for (const auto& c : local.corners)
      corners.push_back({ nodes[c[0]], nodes[c[1]], nodes[c[2]], nodes[c[3]], std::int32_t(e), local.best });
  }
  return corners;
}

double scaledJacobian(const Corner& corner, const Points& points) { return unitJacobian(corner, points).determinant(); }

std::vector<ElementQuality> elementQuality(const ElementMesh& mesh)
{
  struct Sums
  {
    double minimum = 2, jacobians = 0, conditions = 0;
    int corners = 0;
  };
  std::vector<Sums> sums(mesh.elements.size());
  for (const Corner& corner : cornersOf(mesh.elements))
  {
    const Eigen::Matrix3d jacobian = unitJacobian(corner, mesh.points);
    const double determinant = jacobian.determinant();
    Sums& sum = sums[corner.element];
    ++sum.corners;
    sum.minimum = std::min(sum.minimum, determinant);
    sum.jacobians += determinant;
    if (determinant > 0) sum.conditions += jacobian.norm() * jacobian.inverse().norm();
  }
  std::vector<ElementQuality> quality(sums.size());
  for (std::size_t e = 0; e < sums.size(); ++e)
  {
    const Sums& sum = sums[e];
    if (sum.corners == 0) continue;
    quality[e] = { sum.minimum, sum.jacobians / sum.corners, sum.minimum > 0 ? 3 * sum.corners / sum.conditions : 0 };
  }
  return quality;
}

QualitySummary summaryOf(const ElementMesh& mesh, const std::vector<ElementQuality>& quality, ElementShape shape)
{
  QualitySummary summary;
  double means = 0, skews = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    if (mesh.elements[e].shape != shape) continue;
    const ElementQuality& q = quality[e];
    ++summary.elements;
    if (!(q.minimum > 0)) ++summary.invalid;
    summary.minimum = std::min(summary.minimum, q.minimum);
    means += q.mean;
    skews += q.shapeSkew;
    const int bins = int(summary.histogram.size());
    ++summary.histogram[std::clamp(int((q.minimum + 1) / 2 * bins), 0, bins - 1)];
  }
  if (summary.elements == 0) return summary;
  summary.mean = means / double(summary.elements);
  summary.meanShapeSkew = skews / double(summary.elements);
  return summary;
}

} // namespace surgicalmesher
