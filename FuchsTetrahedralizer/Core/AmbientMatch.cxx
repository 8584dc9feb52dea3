// SPDX-License-Identifier: Apache-2.0
#include "AmbientMatch.h"

#include "FaceAdjacency.h"
#include "Parallel.h"

#include <algorithm>
#include <utility>

namespace surgicalmesher
{
namespace
{

/// A triangle by its positions, the smallest first and oriented with the higher label behind, and its labels, the
/// higher first. Equal triangles compare equal whatever their numbering.
using PlacedTriangle = std::pair<std::array<std::array<double, 3>, 3>, std::array<Label, 2>>;

std::vector<PlacedTriangle> placedTriangles(const SurfaceComplex& surface)
{
  std::vector<PlacedTriangle> result;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    auto [a, b, c] = surface.triangles[t];
    auto [behind, front] = surface.labels[t];
    if (behind < front)
    {
      std::swap(behind, front);
      std::swap(b, c);
    }
    const auto at = [&](std::int32_t id) {
      return std::array<double, 3>{ surface.points[id].x, surface.points[id].y, surface.points[id].z };
    };
    std::array<std::array<double, 3>, 3> corners{ at(a), at(b), at(c) };
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.emplace_back(corners, std::array<Label, 2>{ behind, front });
  }
  std::sort(result.begin(), result.end());
  return result;
}

} // namespace

bool isInterfaceOf(const SurfaceComplex& surface, const TetMesh& background)
{
  if (surface.labels.size() != surface.triangles.size()) return false;
  std::vector<PlacedTriangle> wanted, found;
  runInParallel(
    { [&] { found = placedTriangles(interfaceOf(background)); }, [&] { wanted = placedTriangles(surface); } });
  return found == wanted;
}

} // namespace surgicalmesher
