// SPDX-License-Identifier: Apache-2.0
#include "Structures.h"

#include <algorithm>

namespace surgicalmesher
{
namespace
{

/// Mean grid position of each region's voxels, mm.
std::vector<Vec3> centresOf(const TissueMap& map, const Regions& regions)
{
  const Vec3& s = map.grid.spacing;
  std::vector<Vec3> sums(regions.list.size());
  forEachRun(regions, map.grid.size[0],
             [&](std::uint32_t region, std::size_t begin, std::size_t end)
             {
               const auto [i, j, k] = map.grid.voxelAt(begin);
               const double count = double(end - begin);
               sums[region] += count * Vec3{ (2 * i + count - 1) / 2 * s.x, j * s.y, k * s.z };
             });
  for (std::size_t r = 0; r < sums.size(); ++r)
  {
    if (regions.list[r].voxels > 0) sums[r] = sums[r] / double(regions.list[r].voxels);
  }
  return sums;
}

} // namespace

std::string nameOf(Label label, const TissueTable& table)
{
  if (label == 0) return "background";
  const auto found = table.find(label);
  return found == table.end() || found->second.name.empty() ? "tissue " + std::to_string(label) : found->second.name;
}

std::vector<Structure> structuresOf(const TissueMap& map)
{
  const Regions regions = connectedRegions(map);
  const std::vector<Betti> topology = regionTopology(map, regions);
  const std::vector<Vec3> centres = centresOf(map, regions);
  std::vector<Structure> structures;
  for (std::size_t r = 1; r < regions.list.size(); ++r)
  {
    const auto [label, voxels] = regions.list[r];
    if (label == 0) continue;
    structures.push_back({ label, nameOf(label, map.table), voxels, map.grid.gridToWorld(centres[r]), topology[r] });
  }
  std::stable_sort(structures.begin(), structures.end(),
                   [](const Structure& a, const Structure& b)
                   { return a.label != b.label ? a.label < b.label : a.voxels > b.voxels; });
  for (std::size_t begin = 0, end; begin < structures.size(); begin = end)
  {
    end = begin;
    while (end < structures.size() && structures[end].label == structures[begin].label) ++end;
    for (std::size_t n = begin; end - begin > 1 && n < end; ++n)
      structures[n].name += " " + std::to_string(n - begin + 1);
  }
  return structures;
}

} // namespace surgicalmesher
