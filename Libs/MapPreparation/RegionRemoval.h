// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Removal of small regions from a map.

#include "DigitalTopology.h"
#include "PaddedMap.h"

#include <set>
#include <vector>

namespace surgicalmesher
{

/// The voxels of the regions to remove, ascending, and the labels that they had. Between closed labels, some may keep
/// their label.
struct RemovedVoxels
{
  std::vector<std::size_t> voxels;
  std::vector<Label> labels;
};

/// For each region, whether it is the largest of its label (of equals, the first). Region 0 always is, and does not
/// compete with the other regions of background.
std::vector<bool> largestRegions(const Regions& regions);

/// Gives the voxels of the chosen regions to the labels around them, from the outside of each region inwards: every
/// voxel goes to the label with which it shares the largest surface. `regions` are those of `map`; region 0 must not be
/// chosen. Labels in `closed` gain nothing: a region that only they surround stays.
RemovedVoxels removeRegions(PaddedMap& map, const Regions& regions, const std::vector<bool>& chosen,
                            const std::set<Label>& closed = {});

} // namespace surgicalmesher
