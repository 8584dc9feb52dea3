// SPDX-License-Identifier: Apache-2.0
#include "InteriorRefill.h"

#include "Compaction.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "SurfaceTetrahedralization.h"

#include <algorithm>
#include <map>
#include <optional>

namespace surgicalmesher
{
namespace
{

/// A tissue has room if at least this share of its tetrahedra touches no boundary.
constexpr double kInnerShare = 0.1;

/// Lower bound on the number of lattice tetrahedra that fit the tissue's volume over the number that it has. Below, the
/// shape of the tissue requires tetrahedra smaller than L, and the lattice's would not fit.
constexpr double kLeastDensity = 0.5;

/// Returns the number of tetrahedra of the lattice with mean edge `length` that fill the volume: 12 per cube.
double latticeTetrahedra(double volume, double length)
{
  const double cube = length / kLatticeMeanEdge;
  return 12 * volume / (cube * cube * cube);
}

std::optional<TetMesh> filled(const SurfaceComplex& surface, const SizingFunction& edgeLength, const std::string& name,
                              VertexPlacement placement)
{
  try
  {
    return fillWithTetrahedra(surface, edgeLength, name, placement);
  }
  catch (const EngineError&)
  {
    return {};
  }
}

} // namespace

std::set<Label> tissuesWithRoom(const TetMesh& ambient, const SizingFunction& edgeLength)
{
  std::vector<std::int32_t> onInterface;
  interfaceOf(ambient, &onInterface);
  std::vector<char> isInner(ambient.points.size(), 1);
  for (const std::int32_t id : onInterface) isInner[id] = 0;
  struct Count
  {
    std::size_t all = 0, inner = 0;
    double inLattice = 0;
  };
  std::map<Label, Count> counts;
  for (std::size_t t = 0; t < ambient.tetrahedra.size(); ++t)
  {
    const auto& corners = ambient.tetrahedra[t];
    if (ambient.labels[t] == 0) continue;
    Count& count = counts[ambient.labels[t]];
    ++count.all;
    const auto at = [&](int corner) { return ambient.points[corners[corner]]; };
    const Vec3 middle = 0.25 * (at(0) + at(1) + at(2) + at(3));
    count.inLattice += latticeTetrahedra(orient(at(0), at(1), at(2), at(3)) / 6, edgeLength(middle));
    count.inner += std::all_of(corners.begin(), corners.end(), [&](std::int32_t id) { return isInner[id] != 0; });
  }
  std::set<Label> result;
  for (const auto& [label, count] : counts)
    if (double(count.inner) >= kInnerShare * double(count.all) && count.inLattice >= kLeastDensity * double(count.all))
      result.insert(label);
  return result;
}

TetMesh withLatticeInside(const TetMesh& ambient, const std::set<Label>& tissues, const SizingFunction& edgeLength,
                          const std::string& name, VertexPlacement placement)
{
  if (tissues.empty()) return ambient;
  TetMesh masked = ambient;
  for (Label& label : masked.labels) label = tissues.count(label) > 0 ? label : Label(0);
  std::vector<std::int32_t> ambientId; // of the surface's points, then of the new points
  const SurfaceComplex surface = interfaceOf(masked, &ambientId);
  const std::optional<TetMesh> inside = filled(surface, edgeLength, name, placement);
  if (!inside) return ambient;
  TetMesh result;
  result.points = ambient.points;
  for (std::size_t i = surface.points.size(); i < inside->points.size(); ++i)
  {
    ambientId.push_back(std::int32_t(result.points.size()));
    result.points.push_back(inside->points[i]);
  }
  const auto add = [&](std::array<std::int32_t, 4> tetrahedron, Label label)
  {
    result.tetrahedra.push_back(tetrahedron);
    result.labels.push_back(label);
  };
  for (std::size_t t = 0; t < ambient.tetrahedra.size(); ++t)
    if (masked.labels[t] == 0) add(ambient.tetrahedra[t], ambient.labels[t]);
  for (std::size_t t = 0; t < inside->tetrahedra.size(); ++t)
  {
    if (inside->labels[t] == 0) continue;
    std::array<std::int32_t, 4> tetrahedron = inside->tetrahedra[t];
    for (std::int32_t& id : tetrahedron) id = ambientId[id];
    add(tetrahedron, inside->labels[t]);
  }
  result.points = valuesAt(result.points, compactPoints(result.tetrahedra, result.points.size()));
  return result;
}

} // namespace surgicalmesher
