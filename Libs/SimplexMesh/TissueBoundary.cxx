// SPDX-License-Identifier: Apache-2.0
#include "TissueBoundary.h"

#include "FaceAdjacency.h"
#include "InterfaceSmoothing.h"
#include "KuhnLattice.h"

#include <limits>

namespace surgicalmesher
{

namespace
{

double meanEdge(const SurfaceComplex& surface)
{
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += norm(surface.points[a] - surface.points[b]) + norm(surface.points[b] - surface.points[c]);
  return surface.triangles.empty() ? 1 : sum / (2. * double(surface.triangles.size()));
}

Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length2 = squaredNorm(ab);
  return length2 > 0 ? a + std::clamp(dot(p - a, ab) / length2, 0., 1.) * ab : a;
}

} // namespace

Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 n = cross(b - a, c - a);
  const auto inside = [&](const Vec3& q, const Vec3& r) { return dot(cross(r - q, p - q), n) >= 0; };
  if (squaredNorm(n) > 0 && inside(a, b) && inside(b, c) && inside(c, a)) return p - dot(p - a, n) / squaredNorm(n) * n;
  Vec3 best = nearestOnSegment(p, a, b);
  for (const Vec3& q : { nearestOnSegment(p, b, c), nearestOnSegment(p, c, a) })
    if (squaredNorm(q - p) < squaredNorm(best - p)) best = q;
  return best;
}

SurfaceComplex smoothedBoundary(const TissueMap& map)
{
  KuhnLattice lattice = kuhnLattice(map, uniformScale(1e6), {});
  smoothInterface(lattice, map.grid.spacing);
  return interfaceOf(lattice.background.mesh);
}

TissueBoundary::TissueBoundary(const SurfaceComplex& surface, double reach)
  : m_Surface(surface), m_Reach(reach), m_Cell(1.2 * meanEdge(surface)), m_Grid(m_Cell)
{
  for (std::size_t t = 0; t < m_Surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = m_Surface.triangles[t];
    Box box = Box::around(m_Surface.points[a]);
    box.add(m_Surface.points[b]);
    box.add(m_Surface.points[c]);
    m_Grid.insert(std::int32_t(t), box);
    m_Centroids.push_back((m_Surface.points[a] + m_Surface.points[b] + m_Surface.points[c]) / 3);
    double radius = 0;
    for (std::int32_t p : m_Surface.triangles[t]) radius = std::max(radius, norm(m_Surface.points[p] - m_Centroids[t]));
    m_Radii.push_back(radius);
  }
}

std::optional<BoundaryPoint> TissueBoundary::nearest(const Vec3& p, const std::array<Label, 2>& tissues) const
{
  BoundaryPoint found;
  found.distance = std::numeric_limits<double>::infinity();
  const auto& points = m_Surface.points;
  for (double radius = std::min(0.5 * m_Cell, m_Reach);; radius = std::min(2 * radius, m_Reach))
  {
    m_Grid.visit(Box::around(p, radius),
                 [&](std::int32_t t)
                 {
                   const auto& labels = m_Surface.labels[t];
                   const bool same = labels == tissues;
                   const double farthest = found.distance + m_Radii[t];
                   if (!same && !(labels[0] == tissues[1] && labels[1] == tissues[0])) return true;
                   if (squaredNorm(p - m_Centroids[t]) >= farthest * farthest) return true;
                   const auto& [a, b, c] = m_Surface.triangles[t];
                   const Vec3 q = nearestOnTriangle(p, points[a], points[b], points[c]);
                   const double distance = norm(q - p);
                   if (distance >= found.distance) return true;
                   const Vec3 n = cross(points[b] - points[a], points[c] - points[a]);
                   found = { q, (same ? 1 : -1) / std::max(norm(n), 1e-300) * n, distance };
                   return true;
                 });
    if (found.distance <= radius) return found;
    if (radius >= m_Reach) return std::nullopt;
  }
}

} // namespace surgicalmesher
