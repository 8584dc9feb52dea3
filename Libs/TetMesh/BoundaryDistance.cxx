// SPDX-License-Identifier: Apache-2.0
#include "BoundaryDistance.h"
#include "Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace surgicalmesher
{

namespace
{

using Voxel = std::array<int, 3>;

/// Calls f(voxel) for the voxels on the surface of the cube of half-width `reach` around `centre`.
template <class F>
void forEachInShell(const Voxel& centre, int reach, F&& f)
{
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
    {
      const bool isInside = std::max(std::abs(j), std::abs(k)) < reach;
      for (int i = -reach; i <= reach; i += isInside ? 2 * reach : 1)
        f(Voxel{ centre[0] + i, centre[1] + j, centre[2] + k });
    }
}

double distanceToFaces(const TissueMap& map, const Vec3& p, const Voxel& centre)
{
  constexpr int mostReach = 4; // voxels
  const Vec3 spacing = map.grid.spacing;
  const double least = map.grid.smallestSpacing();
  double best = mostReach * least * mostReach * least;
  for (int reach = 0; reach <= mostReach; ++reach)
  {
    const double farther = (reach - 1) * least; // lower bound for all faces of this shell
    if (reach > 0 && best <= farther * farther) break;
    forEachInShell(centre, reach,
                   [&](const Voxel& v)
                   {
                     const Label label = labelAt(map, v);
                     for (int axis = 0; axis < 3; ++axis)
                     {
                       Voxel next = v;
                       ++next[axis];
                       if (labelAt(map, next) != label)
                         best = std::min(best, squaredDistanceToFace(p, v, axis, spacing));
                     }
                   });
  }
  return std::sqrt(best);
}

} // namespace

double squaredDistanceToFace(const Vec3& p, const std::array<int, 3>& v, int axis, const Vec3& spacing)
{
  double d2 = 0;
  for (int a = 0; a < 3; ++a)
  {
    const double off = std::abs(p[a] - (a == axis ? v[a] + 0.5 : v[a]) * spacing[a]);
    const double beyond = std::max(0.0, off - (a == axis ? 0 : 0.5 * spacing[a]));
    d2 += beyond * beyond;
  }
  return d2;
}

std::vector<double> boundaryDistances(const SurfaceComplex& surface, const TissueMap& map)
{
  std::vector<Label> front(surface.points.size(), 0);
  for (std::size_t t = surface.triangles.size(); t-- > 0;)
    for (std::int32_t v : surface.triangles[t]) front[v] = surface.labels[t][1];
  std::vector<double> out(surface.points.size());
  parallelFor(out.size(),
              [&](vtkIdType v)
              {
                const Vec3& p = surface.points[v];
                Voxel centre;
                for (int a = 0; a < 3; ++a) centre[a] = int(std::lround(p[a] / map.grid.spacing[a]));
                const double distance = distanceToFaces(map, p, centre);
                out[v] = labelAt(map, centre) == front[v] ? distance : -distance;
              });
  return out;
}

} // namespace surgicalmesher
