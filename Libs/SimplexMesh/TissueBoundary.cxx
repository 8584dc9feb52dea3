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

} // namespace

// By Voronoi regions of the triangle (Ericson 2005, 5.1.5).
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return d1 - d3 > 0 ? a + d1 / (d1 - d3) * ab : a;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return d2 - d6 > 0 ? a + d2 / (d2 - d6) * ac : a;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / std::max(1e-300, (d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return sum > 0 ? a + vb / sum * ab + vc / sum * ac : a;
}

SurfaceComplex smoothedBoundary(const TissueMap& map)
{
  KuhnLattice lattice = kuhnLattice(map, uniformScale(1e6), {});
  smoothInterface(lattice, map.grid.spacing);
  return interfaceOf(lattice.background.mesh);
}

TissueBoundary::TissueBoundary(const SurfaceComplex& surface, double reach)
  : m_Surface(surface), m_Reach(reach), m_Cell(1.2 * meanEdge(surface)), m_Grid(m_Cell),
    m_SampleGrid(std::max(m_Cell, 0.5 * reach))
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
  addSamples();
}

void TissueBoundary::addSamples()
{
  std::vector<std::vector<std::array<Label, 2>>> seen(m_Surface.points.size());
  for (std::size_t t = 0; t < m_Surface.triangles.size(); ++t)
  {
    const std::array<Label, 2>& labels = m_Surface.labels[t];
    m_Samples.push_back({ m_Centroids[t], labels });
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = m_Surface.triangles[t][k], b = m_Surface.triangles[t][(k + 1) % 3];
      if (a < b) m_Samples.push_back({ 0.5 * (m_Surface.points[a] + m_Surface.points[b]), labels });
      if (std::find(seen[a].begin(), seen[a].end(), labels) != seen[a].end()) continue;
      seen[a].push_back(labels);
      m_Samples.push_back({ m_Surface.points[a], labels });
    }
  }
  for (std::size_t s = 0; s < m_Samples.size(); ++s) m_SampleGrid.insert(std::int32_t(s), Box::around(m_Samples[s].p));
}

std::optional<BoundaryPoint> TissueBoundary::nearest(const Vec3& p, const std::array<Label, 2>& tissues) const
{
  BoundaryPoint found;
  found.distance = std::numeric_limits<double>::infinity();
  const auto& points = m_Surface.points;
  for (double radius = std::min(0.25 * m_Cell, m_Reach);; radius = std::min(2 * radius, m_Reach))
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
