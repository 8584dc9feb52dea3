// SPDX-License-Identifier: Apache-2.0
#include "FacetShape.h"
#include "SimplexOperators.h"

namespace surgicalmesher
{

namespace
{

bool disjoint(const Box& a, const Box& b)
{
  return a.low.x > b.high.x || a.low.y > b.high.y || a.low.z > b.high.z || b.low.x > a.high.x || b.low.y > a.high.y ||
         b.low.z > a.high.z;
}

} // namespace

double SimplexOperators::distanceAt(const Vec3& p, const std::array<Label, 2>& labels) const
{
  const auto nearest = m_Boundary.nearest(p, labels);
  return nearest ? nearest->distance : 2 * m_Boundary.reach();
}

double SimplexOperators::distanceOfPoint(std::int32_t p, const std::array<Label, 2>& labels)
{
  auto& known = m_Distances[p];
  for (const auto& [between, distance] : known)
    if (between == labels) return distance;
  known.emplace_back(labels, distanceAt(m_Points[p], labels));
  return known.back().second;
}

SimplexOperators::Fit SimplexOperators::fitOf(const Triangle& t)
{
  const auto corners = cornersOf(t).corners;
  const Vec3 centroid = (corners[0] + corners[1] + corners[2]) / 3,
             n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  double farthest = 0;
  for (std::int32_t p : t.corners) farthest = std::max(farthest, distanceOfPoint(p, t.labels));
  for (int k = 0; m_Limits.isBoundStrict && k < 3; ++k)
    if (t.corners[k] < t.corners[(k + 1) % 3]) // once for both triangles of an interface
      farthest = std::max(farthest, distanceAt(0.5 * (corners[k] + corners[(k + 1) % 3]), t.labels));
  Fit fit;
  const auto nearest = m_Boundary.nearest(centroid, t.labels);
  farthest = std::max(farthest, nearest ? nearest->distance : 2 * m_Boundary.reach());
  if (nearest) fit.cosine = dot(n, nearest->normal) / std::max(1e-300, norm(n));
  fit.distance = farthest / m_Limits.proximity(centroid);
  return fit;
}

SimplexOperators::Patch SimplexOperators::patchOf(const std::vector<Triangle>& triangles) const
{
  Patch patch;
  for (const Triangle& t : triangles)
  {
    const CornerTriangle shape = cornersOf(t);
    const auto& [a, b, c] = shape.corners;
    const Vec3 centroid = (a + b + c) / 3;
    patch.facets.push_back(
      { shape, t.labels, centroid, std::max({ norm(a - centroid), norm(b - centroid), norm(c - centroid) }) });
    patch.quality = std::min(patch.quality, qualityOf(patch.facets.back().shape));
  }
  return patch;
}

void SimplexOperators::addFits(Patch& patch, const std::vector<std::int32_t>& old)
{
  for (std::int32_t t : old)
  {
    if (m_Fits[t].distance < 0) m_Fits[t] = fitOf(m_Triangles[t]);
    patch.fit.distance = std::max(patch.fit.distance, m_Fits[t].distance);
    patch.fit.cosine = std::min(patch.fit.cosine, m_Fits[t].cosine);
  }
}

bool SimplexOperators::fits(const std::vector<Triangle>& fresh, const Fit& before)
{
  return std::all_of(fresh.begin(), fresh.end(),
                     [&](const Triangle& t)
                     {
                       const Fit fit = fitOf(t);
                       return fit.distance <= std::max(1., before.distance) &&
                              fit.cosine >= std::min(m_Limits.minimumCosine, before.cosine);
                     });
}

/// Whether a triangle of `after` has turned by more than 60 degrees.
bool SimplexOperators::turns(const Patch& before, const Patch& after) const
{
  const auto normal = [](const Facet& f)
  { return cross(f.shape.corners[1] - f.shape.corners[0], f.shape.corners[2] - f.shape.corners[0]); };
  for (std::size_t i = 0; i < after.facets.size(); ++i)
  {
    const Vec3 m = normal(before.facets[i]), n = normal(after.facets[i]);
    if (dot(m, n) < 0.5 * norm(m) * norm(n)) return true;
  }
  return false;
}

bool SimplexOperators::crosses(const std::vector<std::int32_t>& old, const std::vector<Triangle>& fresh) const
{
  for (std::size_t i = 0; i < fresh.size(); ++i)
  {
    const CornerTriangle shape = cornersOf(fresh[i]);
    for (std::size_t j = 0; j < i; ++j)
      if (trianglesCross(shape, cornersOf(fresh[j]))) return true;
    const Box box = boxOf(shape);
    bool apart = true;
    m_Grid.visit(box,
                 [&](std::int32_t t)
                 {
                   const CornerTriangle other = cornersOf(m_Triangles[t]);
                   const bool stays = !disjoint(box, boxOf(other)) && std::find(old.begin(), old.end(), t) == old.end();
                   return apart = !stays || !trianglesCross(shape, other);
                 });
    if (!apart) return true;
  }
  return false;
}

bool SimplexOperators::coveredElsewhere(const Vec3& p, double within, const std::array<Label, 2>& labels,
                                        const std::vector<std::int32_t>& old) const
{
  bool covered = false;
  m_Grid.visit(Box::around(p, within),
               [&](std::int32_t t)
               {
                 if (m_Triangles[t].labels != labels || std::find(old.begin(), old.end(), t) != old.end()) return true;
                 const auto& [a, b, c] = cornersOf(m_Triangles[t]).corners;
                 covered = squaredNorm(nearestOnTriangle(p, a, b, c) - p) <= within * within;
                 return !covered;
               });
  return covered;
}

bool SimplexOperators::staysCovered(const Patch& before, const Patch& after, const std::vector<std::int32_t>& old) const
{
  Box box = boxOf(before.facets[0].shape);
  for (const Facet& f : before.facets)
    for (const Vec3& p : f.shape.corners) box.add(p);
  const double bound = m_Limits.proximity(0.5 * (box.low + box.high));
  if (m_Limits.isBoundStrict)
  {
    box.add(box.low - Vec3{ bound, bound, bound });
    box.add(box.high + Vec3{ bound, bound, bound });
  }
  bool holds = true;
  const auto visit = [&](const Vec3& p, std::array<Label, 2> labels)
  {
    if (labels[0] < labels[1]) std::swap(labels[0], labels[1]);
    const auto distanceTo = [&](const Patch& patch)
    {
      double best = 2 * bound; // farther samples belong to other parts of the surface
      for (const Facet& f : patch.facets)
      {
        if (f.labels != labels || norm(p - f.centroid) >= best + f.radius) continue;
        const auto& [a, b, c] = f.shape.corners;
        best = std::min(best, norm(nearestOnTriangle(p, a, b, c) - p));
      }
      return best;
    };
    const double now = distanceTo(after);
    if (now <= bound) return true;
    const double limit = m_Limits.isBoundStrict ? bound : std::max(bound, distanceTo(before));
    holds = now <= limit || coveredElsewhere(p, limit, labels, old);
    return holds;
  };
  if (m_Limits.isBoundStrict) m_Boundary.allSamples(box, visit);
  else m_Boundary.samples(box, visit);
  return holds;
}

} // namespace surgicalmesher
