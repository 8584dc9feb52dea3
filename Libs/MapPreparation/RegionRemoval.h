// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small regions of a map and how they go.

#include "DigitalTopology.h"
#include "PaddedMap.h"

#include <set>
#include <vector>

namespace surgicalmesher
{

/// Voxels that changed hands, ascending, and the labels they had.
struct RemovedVoxels
{
  std::vector<std::size_t> voxels;
  std::vector<Label> labels;
};

/// For each region, whether it is the largest of its label (of equals, the first). Region 0 stands alone.
std::vector<bool> largestRegions(const Regions& regions);

/// Gives the voxels of the chosen regions to the labels around them, from the outside of each region inwards: every
/// voxel goes to the label with which it shares most surface. `regions` are those of `map`; region 0 is not to be chosen. Labels in `closed` take nothing: a region that only they surround stays.
RemovedVoxels removeRegions(PaddedMap& map, const Regions& regions, const std::vector<bool>& chosen,
                            const std::set<Label>& closed = {});

} // namespace surgicalmesher
