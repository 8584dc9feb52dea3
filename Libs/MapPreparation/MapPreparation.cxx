// SPDX-License-Identifier: Apache-2.0
#include "MapPreparation.h"

#include "ContactResolver.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace surgicalmesher
{
namespace
{

double volumeFor(Label label, const std::map<Label, double>& exceptions, double general)
{
  const auto exception = exceptions.find(label);
  return exception == exceptions.end() ? general : exception->second;
}

/// The volume below which each region of background is removed.
std::vector<double> cavityVolumes(const PaddedMap& map, const Regions& regions, const PreparationOptions& options)
{
  const double general = options.minimumCavityVolume;
  std::vector<double> volumes(regions.list.size(), options.cavityVolumes.empty() ? general : HUGE_VAL);
  if (options.cavityVolumes.empty()) return volumes;
  const auto steps = neighbourSteps(map.grid);
  const auto lower = [&](std::uint32_t region, std::size_t voxel)
  {
    for (const int face : sixNeighbours)
    {
      const Label label = map.labels[voxel + steps[face]];
      if (label != 0) volumes[region] = std::min(volumes[region], volumeFor(label, options.cavityVolumes, general));
    }
  };
  forEachRun(regions, map.grid.size[0],
             [&](std::uint32_t region, std::size_t begin, std::size_t end)
             {
               const bool isCavity = region != 0 && regions.list[region].label == 0;
               for (std::size_t v = begin; isCavity && v < end; ++v) lower(region, v);
             });
  return volumes;
}

/// The regions to be removed: those below the minimum volume, except the largest of each tissue and the outside.
std::vector<bool> findIslands(const PaddedMap& map, const Regions& regions, const PreparationOptions& options)
{
  const Vec3& s = map.grid.spacing;
  const double voxelVolume = s.x * s.y * s.z;
  const std::vector<double> cavities = cavityVolumes(map, regions, options);
  std::vector<bool> isIsland = largestRegions(regions);
  for (std::size_t r = 0; r < regions.list.size(); ++r)
  {
    const auto [label, voxels] = regions.list[r];
    const bool isLargest = isIsland[r] && label != 0;
    const double minimum =
      label == 0 ? cavities[r] : volumeFor(label, options.islandVolumes, options.minimumIslandVolume);
    isIsland[r] = r != 0 && !isLargest && voxels * voxelVolume < minimum;
  }
  return isIsland;
}

/// Unselects the regions that hold a fixed voxel.
void excludeFixed(std::vector<bool>& chosen, const Regions& regions, const Grid& grid, const ContactResolver& resolver)
{
  forEachRun(regions, grid.size[0],
             [&](std::uint32_t region, std::size_t begin, std::size_t end)
             {
               for (std::size_t v = begin; chosen[region] && v < end; ++v) chosen[region] = !resolver.isFixed(v);
             });
}

/// Whether any of the voxels has another label than before.
bool hasChanged(const TissueMap& map, const RemovedVoxels& removed)
{
  for (std::size_t n = 0; n < removed.voxels.size(); ++n)
    if (map.labels[removed.voxels[n]] != removed.labels[n]) return true;
  return false;
}

/// A voxel of the prepared map, and the label that it has in the given one.
struct Differing
{
  std::size_t voxel;
  Label before;
};

/// The differing voxels of slice k.
std::vector<Differing> differencesIn(const TissueMap& map, const PaddedMap& prepared, int k)
{
  std::vector<Differing> result;
  for (int j = 0; j < map.grid.size[1]; ++j)
  {
    const Label* before = map.labels.data() + map.grid.index(0, j, k);
    const std::size_t row = prepared.grid.index(prepared.margin, j + prepared.margin, k + prepared.margin);
    for (int i = 0; i < map.grid.size[0]; ++i)
      if (before[i] != prepared.labels[row + i]) result.push_back({ row + i, before[i] });
  }
  return result;
}

/// Counts every voxel that differs: as an island voxel if it was in an island of the given map, else as a contact
/// voxel.
void countChanges(const TissueMap& map, const PaddedMap& prepared, const std::vector<std::size_t>& islandVoxels,
                  PreparationReport& report)
{
  std::vector<std::vector<Differing>> slices(map.grid.size[2]);
  parallelFor(slices.size(), [&](std::size_t k) { slices[k] = differencesIn(map, prepared, int(k)); });
  for (const std::vector<Differing>& slice : slices)
    for (const auto& [voxel, before] : slice)
    {
      if (std::binary_search(islandVoxels.begin(), islandVoxels.end(), voxel))
      {
        ++report.changes[before].islandVoxels;
        continue;
      }
      ++report.changes[before].voxelsLost;
      ++report.changes[prepared.labels[voxel]].voxelsGained;
      ++report.contactVoxelsChanged;
    }
}

} // namespace

std::size_t countCriticalBlocks(const TissueMap& map) { return findCriticalBlocks(padded(map, 1)).size(); }

PaddedMap preparedMap(const TissueMap& map, int margin, const PreparationOptions& options, PreparationReport& result,
                      const Progress& progress)
{
  report(progress, 0, "Removing islands");
  PaddedMap work = padded(map, margin);
  const auto removeIslands = [&](bool count)
  {
    const Regions regions = connectedRegions(work);
    const std::vector<bool> isIsland = findIslands(work, regions, options);
    for (std::size_t r = 0; count && r < isIsland.size(); ++r)
    {
      if (isIsland[r]) ++result.changes[regions.list[r].label].islandsRemoved;
    }
    return removeRegions(work, regions, isIsland);
  };
  const RemovedVoxels islands = removeIslands(true);

  report(progress, 0.3, "Resolving contacts");
  ContactResolver resolver(work);
  const std::vector<std::size_t> blocks = findCriticalBlocks(work);
  result.criticalBlocksBefore = blocks.size();
  for (const std::size_t block : blocks) resolver.enqueue(block);
  resolver.run();

  // Resolving contacts can cut off new islands, and removing those can make new contacts.
  constexpr int maximumRounds = 20;
  for (int round = 0; round < maximumRounds; ++round)
  {
    report(progress, 0.6 + 0.3 * round / maximumRounds, "Resolving contacts");
    const RemovedVoxels cutOff = removeIslands(false);
    if (cutOff.voxels.empty()) break;
    resolver.updateAfter(cutOff);
    resolver.run();
  }
  countChanges(map, work, islands.voxels, result);
  report(progress, 1, "Resolving contacts");
  return work;
}

PreparationReport prepareMap(TissueMap& map, const PreparationOptions& options, const Progress& progress)
{
  PreparationReport result;
  copyWithoutMargin(preparedMap(map, 1, options, result, progress), map);
  return result;
}

void prepareAgain(PaddedMap& map, const PaddedMap& prepared, const PreparationOptions& options,
                  const ChangeLimits& limits)
{
  ContactResolver resolver(map, prepared, limits.isFixed, limits.closedLabels);
  for (const std::size_t block : findCriticalBlocks(map)) resolver.enqueue(block);
  constexpr int maximumRounds = 20;
  for (int round = 0; round < maximumRounds; ++round)
  {
    resolver.run();
    const Regions regions = connectedRegions(map);
    std::vector<bool> isIsland = findIslands(map, regions, options);
    excludeFixed(isIsland, regions, map.grid, resolver);
    const RemovedVoxels cutOff = removeRegions(map, regions, isIsland, limits.closedLabels);
    if (!hasChanged(map, cutOff)) break;
    resolver.updateAfter(cutOff);
  }
  resolver.run();
}

} // namespace surgicalmesher
