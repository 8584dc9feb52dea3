// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Closed test surfaces. All have tissue `inside` behind their normals and `outside` in front.

#include "TetMesh.h"

#include <cmath>
#include <functional>
#include <map>

namespace surgicalmesher::test
{

/// Adds the triangles of `other` with points of their own.
inline void append(SurfaceComplex& surface, const SurfaceComplex& other)
{
  const auto offset = static_cast<std::int32_t>(surface.points.size());
  surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) surface.triangles.push_back({ a + offset, b + offset, c + offset });
  surface.labels.insert(surface.labels.end(), other.labels.begin(), other.labels.end());
}

/// An octahedron, each triangle split into four `levels` times, its points on a sphere: 8 * 4^levels triangles.
inline SurfaceComplex sphere(const Vec3& centre, double radius, int levels, Label inside = 1, Label outside = 0)
{
  SurfaceComplex surface;
  surface.points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  surface.triangles = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                        { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b)
    {
      const auto [entry, isNew] = middles.emplace(std::make_pair(std::min(a, b), std::max(a, b)),
                                                  static_cast<std::int32_t>(surface.points.size()));
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
    surface.triangles = finer;
  }
  for (Vec3& p : surface.points) p = centre + radius * p;
  surface.labels.assign(surface.triangles.size(), { inside, outside });
  return surface;
}

/// A torus around the z axis.
inline SurfaceComplex torus(double majorRadius, double minorRadius, int aroundMajor, int aroundMinor, Label inside = 1,
                            Label outside = 0)
{
  const double turn = 2 * std::acos(-1.0);
  SurfaceComplex surface;
  for (int i = 0; i < aroundMajor; ++i)
  {
    for (int j = 0; j < aroundMinor; ++j)
    {
      const double u = turn * i / aroundMajor, v = turn * j / aroundMinor;
      const double r = majorRadius + minorRadius * std::cos(v);
      surface.points.push_back({ r * std::cos(u), r * std::sin(u), minorRadius * std::sin(v) });
    }
  }
  const auto id = [&](int i, int j) { return (i % aroundMajor) * aroundMinor + j % aroundMinor; };
  for (int i = 0; i < aroundMajor; ++i)
  {
    for (int j = 0; j < aroundMinor; ++j)
    {
      surface.triangles.push_back({ id(i, j), id(i + 1, j), id(i + 1, j + 1) });
      surface.triangles.push_back({ id(i, j), id(i + 1, j + 1), id(i, j + 1) });
    }
  }
  surface.labels.assign(surface.triangles.size(), { inside, outside });
  return surface;
}

} // namespace surgicalmesher::test
