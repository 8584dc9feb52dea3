// SPDX-License-Identifier: Apache-2.0
#include "InsideTest.h"

#include "Errors.h"
#include "TargetSurface.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;

void requireClosed(const TriangleSurface& surface, const std::string& name)
{
  std::map<std::array<std::int32_t, 2>, int> counts;
  for (const Triangle& t : surface.triangles)
  {
    for (int i = 0; i < 3; ++i) ++counts[{ std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3]) }];
  }
  const auto open = std::count_if(counts.begin(), counts.end(), [](const auto& edge) { return edge.second % 2 != 0; });
  if (open > 0) throw InputError(name + ": " + std::to_string(open) + " open edges, expected a closed surface");
}

} // namespace

InsideTest::InsideTest(const TriangleSurface& surface, const std::string& name) : m_Surface(surface)
{
  requireClosed(surface, name);
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) m_Box.extend(Vector3d(surface.points.col(i)));
  m_Count = std::max(1, int(std::sqrt(double(surface.triangles.size()))));
  m_Triangles.resize(std::size_t(m_Count) * m_Count);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    Eigen::AlignedBox3d box;
    for (const std::int32_t id : surface.triangles[t]) box.extend(Vector3d(surface.points.col(id)));
    const auto low = bucketOf(box.min()), high = bucketOf(box.max());
    for (int j = low[1]; j <= high[1]; ++j)
    {
      for (int i = low[0]; i <= high[0]; ++i) m_Triangles[std::size_t(j) * m_Count + i].push_back(std::int32_t(t));
    }
  }
}

std::array<int, 2> InsideTest::bucketOf(const Vector3d& point) const
{
  std::array<int, 2> bucket{};
  for (int axis = 0; axis < 2; ++axis)
  {
    const double size = m_Box.sizes()[axis];
    const double along = size > 0 ? (point[axis] - m_Box.min()[axis]) / size : 0;
    bucket[axis] = std::clamp(int(along * m_Count), 0, m_Count - 1);
  }
  return bucket;
}

bool InsideTest::passesBeyond(const Vector3d& point, std::int32_t a, std::int32_t b) const
{
  const Vector3d p = m_Surface.points.col(std::min(a, b)), q = m_Surface.points.col(std::max(a, b));
  if ((p.y() > point.y()) == (q.y() > point.y())) return false;
  return point.x() < p.x() + (point.y() - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
}

bool InsideTest::isPierced(const Triangle& t, const Vector3d& point) const
{
  return (passesBeyond(point, t[0], t[1]) != passesBeyond(point, t[1], t[2])) != passesBeyond(point, t[2], t[0]);
}

double InsideTest::heightAt(const Triangle& t, const Vector3d& point) const
{
  const Vector3d a = m_Surface.points.col(t[0]), b = m_Surface.points.col(t[1]), c = m_Surface.points.col(t[2]);
  const Vector3d normal = (b - a).cross(c - a);
  if (normal.z() == 0) return (a.z() + b.z() + c.z()) / 3;
  return a.z() - (normal.x() * (point.x() - a.x()) + normal.y() * (point.y() - a.y())) / normal.z();
}

bool InsideTest::contains(const Vector3d& point) const
{
  if (!m_Box.contains(point)) return false;
  const auto [i, j] = bucketOf(point);
  bool inside = false;
  for (const std::int32_t t : m_Triangles[std::size_t(j) * m_Count + i])
  {
    const Triangle& triangle = m_Surface.triangles[t];
    if (isPierced(triangle, point) && heightAt(triangle, point) > point.z()) inside = !inside;
  }
  return inside;
}

double volumeInside(const TriangleSurface& surface, const InsideTest& inside)
{
  std::vector<Triangle> triangles = surface.triangles;
  const std::vector<std::int32_t> parts = windAlike(triangles);
  const double step = 1e-6 * inside.box().diagonal().norm();
  std::map<std::int32_t, double> volumes;
  std::map<std::int32_t, bool> outwards;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const Vector3d a = surface.points.col(triangles[t][0]), b = surface.points.col(triangles[t][1]),
                   c = surface.points.col(triangles[t][2]);
    const Vector3d area = (b - a).cross(c - a);
    volumes[parts[t]] += a.dot(b.cross(c)) / 6;
    if (outwards.count(parts[t]) == 0 && area.norm() > 0)
      outwards[parts[t]] = !inside.contains((a + b + c) / 3 + step * area.normalized());
  }
  double volume = 0;
  for (const auto& [part, signedVolume] : volumes) volume += outwards[part] ? signedVolume : -signedVolume;
  return volume;
}

} // namespace surgicalmesher
