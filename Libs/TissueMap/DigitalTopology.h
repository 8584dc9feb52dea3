// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Digital topology of a label map: its face-connected regions, and the Betti numbers of every tissue under (6, 26)
/// connectivity (voxels of a tissue are neighbours across faces, those of its complement across corners as well).
///
/// Everything is found for all labels together, in time and memory that grow with the number of *runs* (stretches of
/// equal label along i) rather than with the number of tissues.

#include "TissueMap.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace surgicalmesher
{

struct Betti
{
  int components = 0; ///< b0
  int tunnels = 0;    ///< b1
  int cavities = 0;   ///< b2

  int euler() const { return components - tunnels + cavities; }
  Betti& operator+=(const Betti& part)
  {
    components += part.components;
    tunnels += part.tunnels;
    cavities += part.cavities;
    return *this;
  }
};

inline bool operator==(const Betti& a, const Betti& b)
{
  return a.components == b.components && a.tunnels == b.tunnels && a.cavities == b.cavities;
}

/// Topology of every tissue present (background excluded), in one pass over the grid plus union-find; voxels beyond the
/// grid count as background.
std::map<Label, Betti> tissueTopology(const TissueMap& map);

/// A face-connected set of voxels of one label.
struct Region
{
  Label label = 0;
  std::size_t voxels = 0;
};

/// A maximal stretch of equal label along i; it ends where the next run of its row begins, or with the row.
struct Run
{
  std::uint32_t begin = 0;  ///< i of its first voxel
  std::uint32_t region = 0; ///< index into Regions::list
};

/// All regions of a map, background included. Region 0 is the background outside: what is face-connected to the space
/// beyond the grid; it exists even when it has no voxel. The others are numbered in the order of their first voxels.
struct Regions
{
  std::vector<Region> list;
  std::vector<Run> runs; ///< row by row
  std::vector<std::size_t>
    rowBegins; ///< first run of row (j, k) at [k * size[1] + j]; one more entry ends the last row
};

Regions connectedRegions(const TissueMap& map);

/// Calls visit(region, begin, end) for every run, in memory order; its voxels have the indices [begin, end). `rowSize`
/// is the map's size along i.
template <class Visit>
void forEachRun(const Regions& regions, std::size_t rowSize, const Visit& visit)
{
  for (std::size_t row = 0; row + 1 < regions.rowBegins.size(); ++row)
  {
    for (std::size_t r = regions.rowBegins[row]; r < regions.rowBegins[row + 1]; ++r)
    {
      const std::size_t end = r + 1 < regions.rowBegins[row + 1] ? regions.runs[r + 1].begin : rowSize;
      visit(regions.runs[r].region, row * rowSize + regions.runs[r].begin, row * rowSize + end);
    }
  }
}

/// Topology of each region taken alone, by its index in `regions.list`; region 0 is left at zeros.
std::vector<Betti> regionTopology(const TissueMap& map, const Regions& regions);

} // namespace surgicalmesher
