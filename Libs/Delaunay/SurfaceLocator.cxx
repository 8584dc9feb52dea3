// SPDX-License-Identifier: Apache-2.0
#include "SurfaceLocator.h"

#include <cmath>

namespace surgicalmesher
{
namespace
{

CGAL::Simple_cartesian<double>::Point_3 cgal(const Vec3& p) { return { p.x, p.y, p.z }; }

} // namespace

SurfaceLocator::SurfaceLocator(const SurfaceComplex& surface) : m_Surface(surface)
{
  m_Triangles.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles)
  {
    m_Triangles.emplace_back(cgal(surface.points[a]), cgal(surface.points[b]), cgal(surface.points[c]));
  }
  m_Tree.insert(m_Triangles.begin(), m_Triangles.end());
  m_Tree.build();
  m_Tree.accelerate_distance_queries();
}

SurfaceLocator::Answer SurfaceLocator::ask(const Vec3& p, std::optional<bool> inside) const
{
  const auto [closest, primitive] = m_Tree.closest_point_and_primitive(cgal(p));
  const double squared = CGAL::squared_distance(cgal(p), closest);
  return { std::sqrt(squared), inside ? *inside : labelTowards(p, primitive) != 0 };
}

/// Returns the label at p: that on the near side of the first triangle on the ray to the centroid of the closest one.
/// The closest triangle itself is ambiguous: where the closest point is on its edge, p may lie on either side of its
/// plane.
Label SurfaceLocator::labelTowards(const Vec3& p, Iterator closest) const
{
  const Kernel::Ray_3 ray(cgal(p), CGAL::centroid(*closest));
  const auto hit = m_Tree.first_intersected_primitive(ray);
  const Iterator first = hit ? *hit : closest;
  const auto& [i, j, k] = m_Surface.triangles[first - m_Triangles.begin()];
  const bool front = orient(m_Surface.points[i], m_Surface.points[j], m_Surface.points[k], p) > 0;
  return m_Surface.labels[first - m_Triangles.begin()][front ? 1 : 0];
}

std::optional<SurfaceLocator::Answer> SurfaceWalk::known(const Vec3& p) const
{
  const double least = m_Answer.distance - norm(p - m_Last);
  if (!(least > 0)) return {};
  return SurfaceLocator::Answer{ least, m_Answer.inside };
}

SurfaceLocator::Answer SurfaceWalk::ask(const Vec3& p)
{
  const auto before = known(p);
  m_Answer = m_Locator.ask(p, before ? std::optional<bool>(before->inside) : std::nullopt);
  m_Last = p;
  return m_Answer;
}

} // namespace surgicalmesher
