// SPDX-License-Identifier: Apache-2.0
#include "BoundaryCurvature.h"

#include "Parallel.h"
#include "SmoothBoundary.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

constexpr double fitReach = 2.5;     // voxels; radius of the fit of a curvature to normals
constexpr double quartileReach = 6;  // voxels; wider than the rounding of a straight edge
constexpr double leastCosine = 0.35; // between normals of one sheet

/// Points, sorted into rows of voxels for neighbourhood searches.
class Rows
{
public:
  Rows(const std::vector<SmoothBoundaryPoint>& points, const Grid& grid) : m_Points(points), m_Size(grid.size)
  {
    for (int a = 0; a < 3; ++a)
      m_Radius[a] = int(std::ceil(quartileReach * grid.smallestSpacing() / grid.spacing[a])) + 1;
    m_Rows.resize(std::size_t(m_Size[1]) * m_Size[2]);
    for (std::size_t i = 0; i < points.size(); ++i) m_Rows[row(points[i].voxel[1], points[i].voxel[2])].push_back(i);
    for (auto& row : m_Rows)
      std::sort(row.begin(), row.end(),
                [&](std::size_t a, std::size_t b)
                { return points[a].voxel[0] != points[b].voxel[0] ? points[a].voxel[0] < points[b].voxel[0] : a < b; });
  }

  /// Calls f(number) for the points on the sheet of point i that are within `mm` of it.
  template <class F>
  void forEachNear(std::size_t i, double mm, F&& f) const
  {
    const SmoothBoundaryPoint& point = m_Points[i];
    const auto& [x, y, z] = point.voxel;
    for (int k = std::max(0, z - m_Radius[2]); k <= std::min(m_Size[2] - 1, z + m_Radius[2]); ++k)
      for (int j = std::max(0, y - m_Radius[1]); j <= std::min(m_Size[1] - 1, y + m_Radius[1]); ++j)
      {
        const auto& row = m_Rows[this->row(j, k)];
        auto at = std::lower_bound(row.begin(), row.end(), x - m_Radius[0],
                                   [&](std::size_t n, int from) { return m_Points[n].voxel[0] < from; });
        for (; at != row.end() && m_Points[*at].voxel[0] <= x + m_Radius[0]; ++at)
        {
          const SmoothBoundaryPoint& other = m_Points[*at];
          if (other.labels == point.labels && dot(other.normal, point.normal) > leastCosine &&
              squaredNorm(other.position - point.position) < mm * mm)
            f(*at);
        }
      }
  }

private:
  std::size_t row(int j, int k) const { return std::size_t(k) * m_Size[1] + j; }

  const std::vector<SmoothBoundaryPoint>& m_Points;
  std::array<int, 3> m_Size, m_Radius;
  std::vector<std::vector<std::size_t>> m_Rows;
};

/// Least-squares fit of the linear change of the normal with position in the tangent plane.
class ShapeFit
{
public:
  explicit ShapeFit(const Vec3& normal)
  {
    const Vec3 other = std::abs(normal.x) < 0.6 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 };
    m_U = cross(normal, other);
    m_U = m_U / norm(m_U);
    m_V = cross(normal, m_U);
  }

  void add(const Vec3& way, const Vec3& change)
  {
    const double u = dot(m_U, way), v = dot(m_V, way), a = dot(m_U, change), b = dot(m_V, change);
    m_UU += u * u, m_UV += u * v, m_VV += v * v;
    m_AU += a * u, m_AV += a * v, m_BU += b * u, m_BV += b * v;
  }

  /// The larger principal curvature, 1/mm; 0 if the points lie on a line.
  double curvature() const
  {
    const double det = m_UU * m_VV - m_UV * m_UV, trace = m_UU + m_VV;
    if (!(det > 1e-6 * trace * trace)) return 0;
    const double uu = (m_AU * m_VV - m_AV * m_UV) / det, uv = (m_AV * m_UU - m_AU * m_UV) / det,
                 vu = (m_BU * m_VV - m_BV * m_UV) / det, vv = (m_BV * m_UU - m_BU * m_UV) / det;
    const double mean = 0.5 * (uu + vv), off = 0.5 * (uv + vu);
    return std::abs(mean) + std::hypot(0.5 * (uu - vv), off);
  }

private:
  Vec3 m_U, m_V;
  double m_UU = 0, m_UV = 0, m_VV = 0, m_AU = 0, m_AV = 0, m_BU = 0, m_BV = 0;
};

} // namespace

std::vector<CurvedVoxel> boundaryCurvatures(const TissueMap& map, double voxels)
{
  const std::vector<SmoothBoundaryPoint> points = smoothBoundaryPoints(map, voxels);
  const Rows rows(points, map.grid);
  const double voxel = map.grid.smallestSpacing();
  std::vector<double> fitted(points.size());
  parallelFor(points.size(),
              [&](std::size_t i)
              {
                ShapeFit fit(points[i].normal);
                const auto add = [&](std::size_t n)
                { fit.add(points[n].position - points[i].position, points[n].normal - points[i].normal); };
                rows.forEachNear(i, fitReach * voxel, add);
                fitted[i] = fit.curvature();
              });
  std::vector<CurvedVoxel> result(points.size());
  parallelFor(points.size(),
              [&](std::size_t i)
              {
                std::vector<double> around;
                rows.forEachNear(i, quartileReach * voxel, [&](std::size_t n) { around.push_back(fitted[n]); });
                const auto quartile = around.begin() + std::ptrdiff_t(around.size() / 4);
                std::nth_element(around.begin(), quartile, around.end());
                const auto& [x, y, z] = points[i].voxel;
                result[i] = { map.grid.index(x, y, z), *quartile };
              });
  return result;
}

} // namespace surgicalmesher
