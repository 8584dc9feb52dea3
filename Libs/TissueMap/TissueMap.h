// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The label map that everything starts from, and the tissues in it.

#include "Grid.h"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace surgicalmesher
{

using Label = std::uint16_t;              ///< 0 is background
constexpr std::size_t labelCount = 65536; ///< possible values, for tables by label

struct Tissue
{
  std::string name;                             ///< empty if unknown
  std::array<double, 3> color{ 0.8, 0.8, 0.8 }; ///< RGB in [0, 1]
  bool isShell = false;                         ///< to be meshed as a surface; the inside may stay hollow
  bool isNullDisplacement = false;              ///< held still by the simulation
};

/// Names and colours by label.
using TissueTable = std::map<Label, Tissue>;

struct TissueMap
{
  Grid grid;                 ///< axes permuted and flipped to run along +L, +P, +S as nearly as they can
  std::vector<Label> labels; ///< grid.voxelCount() labels, i fastest
  TissueTable table;         ///< names and colours the file itself carried (.seg.nrrd), else empty
};

/// The label of a voxel, 0 outside the grid.
inline Label labelAt(const TissueMap& map, const std::array<int, 3>& voxel)
{
  const auto [i, j, k] = voxel;
  return map.grid.contains(i, j, k) ? map.labels[map.grid.index(i, j, k)] : Label(0);
}

/// The shortest edges, mm, that meshing voxels of this grid gives: a quarter of their shortest side.
inline double shortestLatticeLength(const Grid& grid) { return grid.smallestSpacing() / 4; }

/// Labels present in the map, ascending, without background.
std::vector<Label> presentLabels(const TissueMap& map);

/// `count` labels, ascending, that neither a voxel of the map, nor its table, nor `named` has: the next after all of
/// these, or where that would end above 65535 the smallest. Fewer if fewer are free.
std::vector<Label> freeLabels(const TissueMap& map, std::size_t count, const std::set<Label>& named = {});

/// Makes the background, all of it, a tissue of that label, which is called "surroundings" if the table has no name for
/// it. False, and no change, if a voxel has the label already.
bool fillBackground(TissueMap& map, Label label);

/// Every n-th voxel along each axis, from voxel (0, 0, 0) on, which stays where it is.
TissueMap everyNth(const TissueMap& map, int n);

/// The same, `size` of them, from voxel `first` on.
TissueMap everyNth(const TissueMap& map, int n, const std::array<int, 3>& first, const std::array<int, 3>& size);

/// Voxels of each label in the map, background included.
std::map<Label, std::size_t> countVoxels(const TissueMap& map);

} // namespace surgicalmesher
