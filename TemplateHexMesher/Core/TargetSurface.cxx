// SPDX-License-Identifier: Apache-2.0
#include "TargetSurface.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;
using Edge = std::array<std::int32_t, 2>;

Edge edgeOf(const Triangle& triangle, int corner)
{
  const auto ends = std::minmax(triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]);
  return { ends.first, ends.second };
}

/// Returns the triangles at each edge, each with its corner opposite to the edge.
std::map<Edge, std::vector<std::pair<std::int32_t, int>>> trianglesAtEdges(const std::vector<Triangle>& triangles)
{
  std::map<Edge, std::vector<std::pair<std::int32_t, int>>> atEdges;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
      atEdges[edgeOf(triangles[t], corner)].emplace_back(std::int32_t(t), corner);
  }
  return atEdges;
}

/// Normal with a length of twice the area.
Vector3d normalOf(const TriangleSurface& surface, const Triangle& t)
{
  const auto& p = surface.points;
  return Vector3d(p.col(t[1]) - p.col(t[0])).cross(Vector3d(p.col(t[2]) - p.col(t[0])));
}

bool windAgainstEachOther(const Triangle& a, int cornerA, const Triangle& b, int cornerB)
{
  return a[(cornerA + 1) % 3] == b[(cornerB + 1) % 3];
}

/// Barycentric weights of the point of triangle abc that is closest to p (Ericson, Real-Time Collision Detection,
/// 5.1.5).
Vector3d closestWeights(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d ab = b - a, ac = c - a;
  const double d1 = ab.dot(p - a), d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return { 1, 0, 0 };
  const double d3 = ab.dot(p - b), d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return { 0, 1, 0 };
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return { 1 - d1 / (d1 - d3), d1 / (d1 - d3), 0 };
  const double d5 = ab.dot(p - c), d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return { 0, 0, 1 };
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return { 1 - d2 / (d2 - d6), 0, d2 / (d2 - d6) };
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6)
  {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return { 0, 1 - t, t };
  }
  return Vector3d(va, vb, vc) / (va + vb + vc);
}

vtkSmartPointer<vtkPolyData> linesOf(const Points& points, const std::vector<Edge>& edges)
{
  vtkNew<vtkPoints> copy;
  copy->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < points.cols(); ++i) copy->InsertNextPoint(points.col(i).data());
  vtkNew<vtkCellArray> cells;
  for (const Edge& edge : edges) cells->InsertNextCell({ edge[0], edge[1] });
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(copy);
  data->SetLines(cells);
  data->BuildCells(); // otherwise done on first use, by several threads at once
  return data;
}

} // namespace

TriangleSurface withoutDuplicates(const TriangleSurface& surface)
{
  std::map<std::array<double, 3>, std::int32_t> ids;
  std::vector<std::int32_t> idOf(surface.points.cols());
  TriangleSurface merged{ Points(3, surface.points.cols()), {} };
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i)
  {
    const std::array<double, 3> key{ surface.points(0, i), surface.points(1, i), surface.points(2, i) };
    idOf[i] = ids.emplace(key, std::int32_t(ids.size())).first->second;
    merged.points.col(idOf[i]) = surface.points.col(i);
  }
  merged.points.conservativeResize(3, Eigen::Index(ids.size()));
  for (const Triangle& t : surface.triangles)
  {
    const Triangle mapped{ idOf[t[0]], idOf[t[1]], idOf[t[2]] };
    const bool isFlat = mapped[0] == mapped[1] || mapped[1] == mapped[2] || mapped[2] == mapped[0];
    if (!isFlat && normalOf(merged, mapped).squaredNorm() > 0) merged.triangles.push_back(mapped);
  }
  return merged;
}

Points cornerNormals(const TriangleSurface& surface, double creaseDegrees)
{
  const auto& triangles = surface.triangles;
  const double least = std::cos(creaseDegrees * M_PI / 180);
  Points areas(3, Eigen::Index(triangles.size()));
  std::vector<std::vector<std::int32_t>> around(surface.points.cols());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    areas.col(Eigen::Index(t)) = normalOf(surface, triangles[t]);
    for (const std::int32_t id : triangles[t]) around[id].push_back(std::int32_t(t));
  }
  const Points units = areas.colwise().normalized();
  Points normals(3, 3 * Eigen::Index(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      Vector3d sum = Vector3d::Zero();
      for (const std::int32_t other : around[triangles[t][corner]])
      {
        if (units.col(other).dot(units.col(Eigen::Index(t))) >= least) sum += areas.col(other);
      }
      normals.col(3 * Eigen::Index(t) + corner) = sum.normalized();
    }
  }
  return normals;
}

std::vector<std::int32_t> windAlike(std::vector<Triangle>& triangles)
{
  std::vector<std::vector<std::pair<std::int32_t, bool>>> neighbours(triangles.size());
  for (const auto& [edge, at] : trianglesAtEdges(triangles))
  {
    if (at.size() != 2) continue;
    const bool against =
      windAgainstEachOther(triangles[at[0].first], at[0].second, triangles[at[1].first], at[1].second);
    neighbours[at[0].first].emplace_back(at[1].first, against);
    neighbours[at[1].first].emplace_back(at[0].first, against);
  }
  std::vector<std::int32_t> parts(triangles.size(), -1);
  std::vector<bool> turned(triangles.size(), false);
  std::int32_t part = 0;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed)
  {
    if (parts[seed] >= 0) continue;
    parts[seed] = part;
    std::vector<std::int32_t> open{ std::int32_t(seed) };
    while (!open.empty())
    {
      const std::int32_t t = open.back();
      open.pop_back();
      for (const auto& [next, against] : neighbours[t])
      {
        if (parts[next] >= 0) continue;
        parts[next] = part;
        turned[next] = turned[t] != against;
        open.push_back(next);
      }
    }
    ++part;
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (turned[t]) std::swap(triangles[t][1], triangles[t][2]);
  }
  return parts;
}

std::vector<Edge> creasesOf(const TriangleSurface& surface, double creaseDegrees)
{
  const double least = std::cos(creaseDegrees * M_PI / 180);
  std::vector<Edge> creases;
  for (const auto& [edge, at] : trianglesAtEdges(surface.triangles))
  {
    if (at.size() != 2) continue;
    const Vector3d a = normalOf(surface, surface.triangles[at[0].first]).normalized();
    const Vector3d b = normalOf(surface, surface.triangles[at[1].first]).normalized();
    if (a.dot(b) < least) creases.push_back(edge);
  }
  return creases;
}

/// Bounding volume hierarchy of the triangles.
class TargetSurface::Tree : public Eigen::KdBVH<double, 3, std::int32_t>
{
public:
  explicit Tree(const TriangleSurface& surface)
  {
    std::vector<std::int32_t> ids(surface.triangles.size());
    std::iota(ids.begin(), ids.end(), 0);
    VolumeList boxes;
    for (const Triangle& t : surface.triangles)
    {
      boxes.emplace_back(Vector3d(surface.points.col(t[0])));
      for (const std::int32_t id : t) boxes.back().extend(Vector3d(surface.points.col(id)));
    }
    init(ids.begin(), ids.end(), boxes.begin(), boxes.end());
  }
};

TargetSurface::TargetSurface(const TriangleSurface& surface) : m_Surface(surface)
{
  m_Parts = windAlike(m_Surface.triangles);
  m_Normals = cornerNormals(m_Surface, kCreaseDegrees);
  m_Borders.assign(m_Surface.triangles.size(), { false, false, false });
  for (const auto& [edge, at] : trianglesAtEdges(m_Surface.triangles))
  {
    if (at.size() == 1) m_Borders[at[0].first][at[0].second] = true;
  }
  m_Tree = std::make_shared<const Tree>(m_Surface);
  buildCreases();
}

void TargetSurface::buildCreases()
{
  const std::vector<Edge> creases = creasesOf(m_Surface, kCreaseDegrees);
  if (creases.empty()) return;
  m_Creases = linesOf(m_Surface.points, creases);
  m_CreaseLocator = vtkSmartPointer<vtkStaticCellLocator>::New();
  m_CreaseLocator->SetDataSet(m_Creases);
  m_CreaseLocator->BuildLocator();
}

void TargetSurface::orientLike(const Points& points, const Points& normals, double reach)
{
  const std::int32_t parts = m_Parts.empty() ? 0 : 1 + *std::max_element(m_Parts.begin(), m_Parts.end());
  std::vector<double> votes(parts, 0), volumes(parts, 0);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    const SurfacePoint nearest = closest(points.col(i), normals.col(i), 0);
    if (nearest.triangle < 0 || (nearest.position - points.col(i)).norm() > reach) continue;
    votes[m_Parts[nearest.triangle]] += nearest.normal.dot(normals.col(i));
  }
  const Vector3d origin = m_Surface.points.rowwise().mean();
  for (std::size_t t = 0; t < m_Parts.size(); ++t)
  {
    const Triangle& triangle = m_Surface.triangles[t];
    volumes[m_Parts[t]] += normalOf(m_Surface, triangle).dot(m_Surface.points.col(triangle[0]) - origin);
  }
  for (std::size_t t = 0; t < m_Parts.size(); ++t)
  {
    const double vote = votes[m_Parts[t]];
    if ((vote != 0 ? vote : volumes[m_Parts[t]]) >= 0) continue;
    std::swap(m_Surface.triangles[t][1], m_Surface.triangles[t][2]);
    std::swap(m_Borders[t][1], m_Borders[t][2]);
  }
  m_Normals = cornerNormals(m_Surface, kCreaseDegrees);
}

SurfacePoint TargetSurface::onTriangle(std::int32_t triangle, const Vector3d& point) const
{
  const Triangle& t = m_Surface.triangles[triangle];
  const auto& p = m_Surface.points;
  SurfacePoint found;
  found.triangle = triangle;
  found.weights = closestWeights(point, p.col(t[0]), p.col(t[1]), p.col(t[2]));
  found.position = p.col(t[0]) * found.weights[0] + p.col(t[1]) * found.weights[1] + p.col(t[2]) * found.weights[2];
  found.normal = (m_Normals.middleCols<3>(3 * Eigen::Index(triangle)) * found.weights).normalized();
  for (int corner = 0; corner < 3; ++corner)
    found.onBorder = found.onBorder || (m_Borders[triangle][corner] && found.weights[corner] <= 1e-9);
  return found;
}

SurfacePoint TargetSurface::closest(const Vector3d& point, const Vector3d& normal, double normalScale) const
{
  struct Query
  {
    using Scalar = double;

    double minimumOnVolume(const Tree::Volume& box) const { return box.squaredExteriorDistance(point); }

    double minimumOnObject(std::int32_t triangle)
    {
      const SurfacePoint found = surface.onTriangle(triangle, point);
      const double cost =
        (found.position - point).squaredNorm() + normalScale * normalScale * (found.normal - normal).squaredNorm();
      if (cost < least || best.triangle < 0)
      {
        least = cost;
        best = found;
      }
      return cost;
    }

    const TargetSurface& surface;
    const Vector3d &point, &normal;
    double normalScale;
    double least = 0;
    SurfacePoint best = {};
  } query{ *this, point, normal, normalScale };
  Eigen::BVMinimize(*m_Tree, query);
  return query.best;
}

SurfacePoint TargetSurface::closestOnCrease(const Vector3d& point, double reach) const
{
  SurfacePoint found;
  if (!m_Creases) return found;
  thread_local vtkNew<vtkGenericCell> cell;
  double position[3], squared = 0;
  vtkIdType id = -1;
  int subId = 0;
  m_CreaseLocator->FindClosestPoint(point.data(), position, cell.GetPointer(), id, subId, squared);
  if (id < 0 || squared > reach * reach) return found;
  found.triangle = std::int32_t(id);
  found.position = Vector3d(position);
  double ends[2][3];
  cell->GetPoints()->GetPoint(0, ends[0]);
  cell->GetPoints()->GetPoint(1, ends[1]);
  found.normal = (Vector3d(ends[1]) - Vector3d(ends[0])).normalized();
  return found;
}

} // namespace surgicalmesher
