// SPDX-License-Identifier: Apache-2.0
#include "Warnings.h"

#include "Place.h"
#include "Structures.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Returns the shortest length at a subset of the voxels: lengths vary slowly.
double shortestLength(const TissueMap& map, const ScaleField& scale)
{
  constexpr int mostSamplesPerAxis = 128;
  const Grid& grid = map.grid;
  std::array<int, 3> step;
  for (int axis = 0; axis < 3; ++axis) step[axis] = (grid.size[axis] - 1) / mostSamplesPerAxis + 1;
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < grid.size[2]; k += step[2])
  {
    for (int j = 0; j < grid.size[1]; j += step[1])
    {
      for (int i = 0; i < grid.size[0]; i += step[0])
      {
        if (map.labels[grid.index(i, j, k)] == 0) continue;
        const Vec3 p{ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z };
        shortest = std::min(shortest, double(scale(grid.gridToWorld(p))));
      }
    }
  }
  return shortest;
}

std::string listed(const std::vector<Label>& piece, const TissueTable& names)
{
  constexpr std::size_t most = 5;
  std::string list;
  for (std::size_t n = 0; n < std::min(most, piece.size()); ++n) list += (n > 0 ? ", " : "") + nameOf(piece[n], names);
  return piece.size() > most ? list + " and " + std::to_string(piece.size() - most) + " more" : list;
}

} // namespace

std::string warningOfShortLengths(const TissueMap& map, const ScaleField& scale, const std::string& labelMap)
{
  const double asked = shortestLength(map, scale), given = shortestLatticeLength(map.grid);
  if (!(asked < 0.95 * given)) return {};
  return "edges of " + text::rounded(asked) + " mm are asked for, but the voxels of " + labelMap +
         " give none shorter than " + text::rounded(given) +
         " mm, a quarter of their side; resample the map for shorter ones";
}

std::vector<std::string> warningsOfGroups(const TissueSelection& selection)
{
  std::vector<std::string> warnings;
  for (const TissueGroup& group : selection.groups)
  {
    if (group.pieces.size() < 2) continue;
    std::string warning = "the tissues of group " + group.name + " are not contiguous, but " +
                          std::to_string(group.pieces.size()) + " pieces:";
    for (std::size_t n = 0; n < group.pieces.size(); ++n)
      warning += (n > 0 ? "; " : " ") + listed(group.pieces[n], selection.tableOfInput);
    warnings.push_back(warning);
  }
  return warnings;
}

std::vector<std::string> warningsOfDistance(const std::map<Label, TissueFidelity>& fidelity, double bound,
                                            const Grid& world)
{
  std::vector<std::string> warnings;
  const auto check = [&](Distances TissueFidelity::*side, const std::string& what)
  {
    const Distances all = allDistances(fidelity, side);
    if (all.beyond == 0) return;
    warnings.push_back("the maximum distance of " + text::rounded(bound) + " mm does not hold: " + what + " up to " +
                       text::rounded(all.maximum) + " mm away, farthest at " +
                       place(world.gridToWorld(all.farthest), 3) + " LPS, and " + std::to_string(all.beyond) + " of " +
                       std::to_string(all.samples) + " places are beyond it");
  };
  check(&TissueFidelity::mapToMesh, "from boundaries of the map the surface is");
  check(&TissueFidelity::meshToMap, "from the surface the boundaries of the map are");
  return warnings;
}

std::string warningOfVolumes(const std::map<Label, TissueFidelity>& fidelity, const TissueMap& map)
{
  constexpr double most = 0.25, leastVoxels = 27; // smaller tissues are more often noise
  constexpr std::size_t listedMost = 5;
  const Vec3& h = map.grid.spacing;
  const double least = (leastVoxels - 0.5) * h.x * h.y * h.z;
  std::vector<std::pair<double, Label>> off;
  for (const auto& [label, tissue] : fidelity)
    if (const double change = tissue.meshVolume / tissue.mapVolume - 1;
        tissue.mapVolume > least && std::abs(change) > most)
      off.emplace_back(change, label);
  if (off.empty()) return {};
  std::stable_sort(off.begin(), off.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  std::string list;
  for (std::size_t n = 0; n < std::min(listedMost, off.size()); ++n)
    list += (n > 0 ? ", " : " ") + nameOf(off[n].second, map.table) + (off[n].first > 0 ? " +" : " ") +
            std::to_string(std::lround(100 * off[n].first)) + " %";
  if (off.size() > listedMost) list += " and " + std::to_string(off.size() - listedMost) + " more";
  return "the volume of " + std::to_string(off.size()) + (off.size() == 1 ? " tissue" : " tissues") +
         " is off by more than a quarter:" + list + "; shorter edges there keep more of it";
}

} // namespace surgicalmesher
