// SPDX-License-Identifier: Apache-2.0
#include "TissueOffsets.h"

#include "Quadric.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

double offsetOf(Label label, const TissueOffsets& offsets)
{
  const auto found = offsets.find(label);
  return found == offsets.end() ? 0 : found->second;
}

} // namespace

SheetSide sideOf(const TetComplex& complex, const SheetFace& f)
{
  const auto at = [&](int k) { return complex.points[f.vertices[k]]; };
  const Vec3 area = 0.5 * cross(at(1) - at(0), at(2) - at(0));
  const Vec3 inside = complex.points[complex.tets[f.tet][f.face]];
  const Label from = complex.labels[f.tet], to = complex.labels[complex.neighbours[f.tet][f.face]];
  return { from, to, dot(area, inside - at(0)) > 0 ? -1.0 * area : area };
}

Vec3 meetingStep(const TetComplex& complex, const Sheet& sheet, const TissueOffsets& offsets)
{
  constexpr double spring = 0.05; // for vertices whose faces lie nearly in one plane
  Quadric quadric;
  for (const SheetFace& f : sheet.faces)
  {
    const SheetSide side = sideOf(complex, f);
    const double size = norm(side.area);
    const Vec3 n = side.area / size;
    const double m[6] = { n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z };
    for (int i = 0; i < 6; ++i) quadric.m[i] += size * m[i];
    quadric.g += (offsetOf(side.from, offsets) - offsetOf(side.to, offsets)) * side.area;
  }
  quadric.addToDiagonal(spring * quadric.trace());
  return quadric.solve(quadric.g);
}

bool moveAlong(GuardedOperations& operations, std::int32_t v, const Vec3& way, double floor)
{
  const Vec3 p = operations.complex().points[v];
  for (const double share : { 1.0, 0.5, 0.25 })
    if (operations.move(v, p + share * way, floor)) return true;
  return false;
}

void offsetTissuesOfBlock(GuardedOperations& operations, const TissueOffsetOptions& options)
{
  const TetComplex& complex = operations.complex();
  const double good = sine2OfDegrees(options.goodAngle);
  const auto stays = [&](std::int32_t t) { return offsetOf(complex.labels[t], options.offsets) == 0; };
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
  {
    if (complex.vertexTet[v] < 0 || complex.locked[v] || !complex.onInterface[v]) continue;
    const std::vector<std::int32_t>& star = operations.star(v);
    if (std::all_of(star.begin(), star.end(), stays)) continue;
    const Vec3 way = meetingStep(complex, operations.sheet(v), options.offsets);
    if (squaredNorm(way) > 0) moveAlong(operations, v, way, std::min(good, operations.qualityAt(v)));
  }
}

} // namespace surgicalmesher
