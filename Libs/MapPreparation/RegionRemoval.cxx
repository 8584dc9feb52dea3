// SPDX-License-Identifier: Apache-2.0
#include "RegionRemoval.h"

#include <tuple>
#include <unordered_map>

namespace surgicalmesher
{
namespace
{

std::vector<std::size_t> voxelsOf(const TissueMap& map, const Regions& regions, const std::vector<bool>& chosen)
{
  std::vector<std::size_t> voxels;
  forEachRun(regions, map.grid.size[0],
             [&](std::uint32_t region, std::size_t begin, std::size_t end)
             {
               for (std::size_t v = begin; chosen[region] && v < end; ++v) voxels.push_back(v);
             });
  return voxels;
}

/// Assigns labels to open voxels, those of the removed regions, layer by layer.
class Peeling
{
public:
  Peeling(TissueMap& map, const std::vector<std::size_t>& open, const std::set<Label>& closed)
    : m_Map(map), m_Steps(neighbourSteps(map.grid)), m_Closed(closed), m_IsOpen(map.labels.size(), false)
  {
    for (const std::size_t v : open) m_IsOpen[v] = true;
    const Vec3& s = map.grid.spacing;
    m_FaceAreas[4] = m_FaceAreas[22] = s.x * s.y;
    m_FaceAreas[10] = m_FaceAreas[16] = s.x * s.z;
    m_FaceAreas[12] = m_FaceAreas[14] = s.y * s.z;
  }

  /// Gives every open voxel that has an assigned face neighbour the best label of these neighbours; returns the other
  /// open voxels.
  std::vector<std::size_t> assignLayer(const std::vector<std::size_t>& open)
  {
    std::vector<std::size_t> rest;
    std::vector<std::pair<std::size_t, Label>> assigned;
    for (const std::size_t v : open)
    {
      Label label = 0;
      if (bestNeighbour(v, label)) assigned.emplace_back(v, label);
      else rest.push_back(v);
    }
    for (const auto& [v, label] : assigned)
    {
      m_Map.labels[v] = label;
      m_IsOpen[v] = false;
    }
    return rest;
  }

private:
  /// Finds the label with the largest face contact to voxel `v`; ties are decided by the number of the 26 neighbours,
  /// then by the lowest label. Returns false if there is none.
  bool bestNeighbour(std::size_t v, Label& result) const
  {
    std::pair<double, int> best{ 0, 0 };
    for (const int face : sixNeighbours)
    {
      const std::size_t neighbour = v + m_Steps[face];
      const Label label = m_Map.labels[neighbour];
      if (m_IsOpen[neighbour] || m_Closed.count(label)) continue;
      const auto shared = contact(v, label);
      if (shared < best || (shared == best && label > result)) continue;
      best = shared;
      result = label;
    }
    return best.first > 0;
  }

  /// Surface that `label` shares with the voxel, mm^2, and its number among the 26 neighbours.
  std::pair<double, int> contact(std::size_t v, Label label) const
  {
    std::pair<double, int> result{ 0, 0 };
    for (int n = 0; n < 27; ++n)
    {
      const std::size_t neighbour = v + m_Steps[n];
      if (m_IsOpen[neighbour] || m_Map.labels[neighbour] != label) continue;
      result.first += m_FaceAreas[n];
      ++result.second;
    }
    return result;
  }

  TissueMap& m_Map;
  std::array<std::ptrdiff_t, 27> m_Steps;
  std::array<double, 27> m_FaceAreas{}; ///< area shared with each of the 3x3x3 neighbours, mm^2
  const std::set<Label>& m_Closed;
  std::vector<bool> m_IsOpen;
};

} // namespace

std::vector<bool> largestRegions(const Regions& regions)
{
  std::unordered_map<Label, std::size_t> largest;
  for (std::size_t r = 1; r < regions.list.size(); ++r)
  {
    const auto [entry, isNew] = largest.emplace(regions.list[r].label, r);
    if (!isNew && regions.list[entry->second].voxels < regions.list[r].voxels) entry->second = r;
  }
  std::vector<bool> result(regions.list.size(), false);
  result[0] = true;
  for (const auto& [label, region] : largest) result[region] = true;
  return result;
}

RemovedVoxels removeRegions(PaddedMap& map, const Regions& regions, const std::vector<bool>& chosen,
                            const std::set<Label>& closed)
{
  std::vector<std::size_t> open = voxelsOf(map, regions, chosen);
  RemovedVoxels removed{ open, {} };
  for (const std::size_t v : open) removed.labels.push_back(map.labels[v]);
  Peeling peeling(map, open, closed);
  for (std::size_t before = 0; open.size() != before;)
  {
    before = open.size();
    open = peeling.assignLayer(open);
  }
  return removed;
}

} // namespace surgicalmesher
