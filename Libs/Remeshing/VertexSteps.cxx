// SPDX-License-Identifier: Apache-2.0
#include "VertexSteps.h"

#include "TetQuality.h"

#include <algorithm>

namespace surgicalmesher
{

Quadric heldAt(GuardedOperations& operations, std::int32_t v, double ease)
{
  Quadric held = resistanceOf(operations.complex(), v, operations.sheet(v));
  held.addToDiagonal(operations.complex().onInterface[v] ? ease * held.trace() : 1);
  return held;
}

Vec3 easiest(GuardedOperations& operations, std::int32_t v, const Quadric& held, const Vec3& direction)
{
  constexpr double rounding = 1e-9;
  const Vec3 wanted = held.solve(direction), d = operations.alongFeatures(v, wanted);
  const double n = norm(d);
  return n > rounding * norm(wanted) ? d / n : Vec3{}; // less is rounding, where features leave no direction
}

void facesAtNeighbours(const Sheet& sheet, std::int32_t v, FacesAtNeighbours& result)
{
  result.clear();
  for (const SheetFace& f : sheet.faces)
    for (const std::int32_t u : f.vertices)
    {
      if (u == v) continue;
      const auto at = std::find_if(result.begin(), result.end(), [u](const auto& n) { return n.first == u; });
      if (at == result.end()) result.push_back({ u, 1 });
      else ++at->second;
    }
}

bool isWhole(GuardedOperations& operations, std::int32_t v)
{
  constexpr std::size_t inLattice = 24;
  static const double good = sine2OfDegrees(45);
  return !operations.complex().onInterface[v] && operations.star(v).size() == inLattice &&
         operations.qualityAt(v) >= good;
}

Vec3 uphill(GuardedOperations& operations, std::int32_t v, const Vec3& p, double worst)
{
  const double h = 1e-4 * operations.complex().lengths[v];
  const Vec3 sum = operations.measured(v).sumOfGradients(p, h, 1.15 * worst);
  const double n = norm(sum);
  return n > 0 ? sum / n : Vec3{ 1, 0, 0 };
}

} // namespace surgicalmesher
