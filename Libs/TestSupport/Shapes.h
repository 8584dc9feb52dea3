// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Closed test surfaces. All have tissue `inside` behind their normals and `outside` in front.

#include "SurfaceShapes.h"

#include <cmath>
#include <functional>

namespace surgicalmesher::test
{

using surgicalmesher::append;
using surgicalmesher::sphere;

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
