// SPDX-License-Identifier: Apache-2.0
#include "AmbientMatch.h"

#include "Errors.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"

#include <algorithm>
#include <tuple>

namespace surgicalmesher
{
namespace
{

using Position = std::tuple<double, double, double>;

/// A triangle by its positions, so that equal ones compare equal wherever their numbering began.
struct Placed
{
  std::array<Position, 3> corners; ///< smallest first, wound with the higher label behind
  std::array<Label, 2> labels;     ///< [higher, lower]
};

bool operator<(const Placed& a, const Placed& b)
{
  return std::tie(a.corners, a.labels) < std::tie(b.corners, b.labels);
}

std::vector<Placed> placedTriangles(const SurfaceComplex& surface)
{
  std::vector<Placed> result;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    Placed placed{ {}, surface.labels[t] };
    for (int c = 0; c < 3; ++c)
    {
      const Vec3& p = surface.points[surface.triangles[t][c]];
      placed.corners[c] = { p.x, p.y, p.z };
    }
    if (placed.labels[0] < placed.labels[1])
    {
      std::swap(placed.labels[0], placed.labels[1]);
      std::swap(placed.corners[1], placed.corners[2]);
    }
    std::rotate(placed.corners.begin(), std::min_element(placed.corners.begin(), placed.corners.end()),
                placed.corners.end());
    result.push_back(placed);
  }
  std::sort(result.begin(), result.end());
  return result;
}

void requireSubset(const std::vector<Placed>& part, const std::string& partName, const std::vector<Placed>& whole,
                   const std::string& wholeName)
{
  std::vector<Placed> missing;
  std::set_difference(part.begin(), part.end(), whole.begin(), whole.end(), std::back_inserter(missing));
  if (missing.empty()) return;
  const auto& [x, y, z] = missing.front().corners[0];
  throw InputError(wholeName + ": " + std::to_string(missing.size()) + " triangles of " + partName +
                   " are missing, the first at " + place({ x, y, z }) +
                   ", expected tetrahedra whose label interfaces are exactly the surface's triangles");
}

} // namespace

void requireInterfacesAre(const SurfaceComplex& surface, const std::string& surfaceName, const TetMesh& ambient,
                          const std::string& ambientName)
{
  const std::vector<Placed> wanted = placedTriangles(surface), found = placedTriangles(interfaceOf(ambient));
  requireSubset(wanted, surfaceName, found, ambientName);
  requireSubset(found, ambientName, wanted, surfaceName);
}

} // namespace surgicalmesher
