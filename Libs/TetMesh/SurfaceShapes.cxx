// SPDX-License-Identifier: Apache-2.0
#include "SurfaceShapes.h"

#include <algorithm>
#include <map>
#include <utility>

namespace surgicalmesher
{

namespace
{

/// Splits each triangle of a unit sphere into four.
void refine(SurfaceComplex& surface)
{
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b)
  {
    const auto [entry, isNew] = middles.emplace(std::minmax(a, b), std::int32_t(surface.points.size()));
    const Vec3 sum = surface.points[a] + surface.points[b];
    if (isNew) surface.points.push_back(sum / norm(sum));
    return entry->second;
  };
  std::vector<std::array<std::int32_t, 3>> finer;
  for (const auto& [a, b, c] : surface.triangles)
  {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
  }
  surface.triangles = std::move(finer);
}

} // namespace

SurfaceComplex sphere(const Vec3& centre, double radius, int levels, Label inside, Label outside)
{
  SurfaceComplex surface;
  surface.points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  surface.triangles = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                        { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
  for (int level = 0; level < levels; ++level) refine(surface);
  for (Vec3& p : surface.points) p = centre + radius * p;
  surface.labels.assign(surface.triangles.size(), { inside, outside });
  return surface;
}

void append(SurfaceComplex& surface, const SurfaceComplex& other)
{
  const auto offset = std::int32_t(surface.points.size());
  surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) surface.triangles.push_back({ a + offset, b + offset, c + offset });
  surface.labels.insert(surface.labels.end(), other.labels.begin(), other.labels.end());
}

} // namespace surgicalmesher
