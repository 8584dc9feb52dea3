// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closed surface of the curved slab.

#include "Slab.h"
#include "SlabParameterisation.h"

namespace surgicalmesher::test
{

/// The slab's surface with its sides; with a hole in the middle when `holed`.
inline Envelope slabEnvelope(bool holed)
{
  ElementMesh mesh = slab(10, 8, 2);
  std::vector<Element> kept;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    const std::size_t i = e % 10, j = e / 10 % 8;
    if (!holed || i < 4 || i > 5 || j < 3 || j > 4) kept.push_back(mesh.elements[e]);
  }
  mesh.elements = kept;
  const auto crossing = [](std::int32_t id) { return std::array<int, 3>{ id % 11, id / 11 % 9, id / 99 }; };
  constexpr std::array<int, 3> last = { 10, 8, 2 };
  constexpr Side low[3] = { Side::Right, Side::Bottom, Side::Inner }, high[3] = { Side::Left, Side::Top, Side::Outer };
  std::vector<Triangle> triangles;
  std::vector<Side> sides;
  for (const Face& face : outerFaces(mesh.elements))
  {
    Side side = Side::Hole;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      int sum = 0;
      for (const std::int32_t id : face.nodes) sum += crossing(id)[axis];
      if (sum == 0) side = low[axis];
      if (sum == 4 * last[axis]) side = high[axis];
    }
    for (const Triangle& t : trianglesOf({ face }, mesh.points))
    {
      triangles.push_back(t);
      sides.push_back(side);
    }
  }
  return { compacted(mesh.points, triangles), sides };
}

} // namespace surgicalmesher::test
