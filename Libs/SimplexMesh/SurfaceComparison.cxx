// SPDX-License-Identifier: Apache-2.0
#include "SurfaceComparison.h"

#include "Parallel.h"
#include "TissueBoundary.h"

#include <limits>

namespace surgicalmesher
{

namespace
{

double diagonal(const SurfaceComplex& surface)
{
  Box box = Box::around(surface.points.at(0));
  for (const Vec3& p : surface.points) box.add(p);
  return norm(box.high - box.low);
}

double angleAt(const Vec3& p, const Vec3& q, const Vec3& r)
{
  return std::atan2(norm(cross(q - p, r - p)), dot(q - p, r - p)) * 180 / std::acos(-1.);
}

} // namespace

SurfaceDistance surfaceDistance(const SurfaceComplex& from, const SurfaceComplex& to)
{
  constexpr int samples = 7; // per triangle
  const TissueBoundary boundary(to, diagonal(from) + diagonal(to));
  std::vector<SurfaceDistance> ofTriangles(from.triangles.size());
  parallelFor(from.triangles.size(),
              [&](std::size_t t)
              {
                const auto& [a, b, c] = from.triangles[t];
                const Vec3 &p = from.points[a], &q = from.points[b], &r = from.points[c];
                SurfaceDistance& own = ofTriangles[t];
                for (const Vec3& x : { p, q, r, 0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p), (p + q + r) / 3 })
                {
                  const auto nearest = boundary.nearest(x, from.labels[t]);
                  const double distance = nearest ? nearest->distance : std::numeric_limits<double>::infinity();
                  own.mean += distance / samples;
                  if (distance > own.maximum) own.maximum = distance, own.where = x;
                }
              });
  SurfaceDistance all;
  for (const SurfaceDistance& own : ofTriangles)
  {
    all.mean += own.mean / double(ofTriangles.size());
    if (own.maximum > all.maximum) all.maximum = own.maximum, all.where = own.where;
  }
  return all;
}

TriangleQuality triangleQuality(const SurfaceComplex& surface)
{
  std::vector<double> angles, edges;
  for (const auto& [a, b, c] : surface.triangles)
  {
    const Vec3 &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
    angles.push_back(std::min({ angleAt(p, q, r), angleAt(q, r, p), angleAt(r, p, q) }));
    for (const double edge : { norm(q - p), norm(r - q), norm(p - r) }) edges.push_back(edge);
  }
  TriangleQuality quality{ distributionOf(angles), distributionOf(edges), 0 };
  for (const double edge : edges)
    quality.edgeVariation += (edge - quality.edgeLength.mean) * (edge - quality.edgeLength.mean) / double(edges.size());
  quality.edgeVariation = std::sqrt(quality.edgeVariation) / std::max(1e-300, quality.edgeLength.mean);
  return quality;
}

} // namespace surgicalmesher
