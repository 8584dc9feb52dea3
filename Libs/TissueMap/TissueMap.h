// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The label map, which is the input of all stages, and the tissues in it.

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
constexpr std::size_t labelCount = 65536; ///< number of possible values, for tables by label

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

/// The shortest edges, mm, that a mesh of this grid can have: a quarter of the shortest voxel side.
inline double shortestLatticeLength(const Grid& grid) { return grid.smallestSpacing() / 4; }

/// Labels present in the map, ascending, without background.
std::vector<Label> presentLabels(const TissueMap& map);

/// Returns `count` labels, ascending, that occur neither in the map's voxels nor in its table nor in `named`: those
/// after the largest label in use or, if these would exceed 65535, the smallest. Returns fewer if fewer are free.
std::vector<Label> freeLabels(const TissueMap& map, std::size_t count, const std::set<Label>& named = {});

/// Turns the whole background into a tissue of that label, named "surroundings" if the table has no name for it.
/// Returns false and changes nothing if a voxel has the label already.
bool fillBackground(TissueMap& map, Label label);

/// Returns every n-th voxel along each axis, starting from voxel (0, 0, 0), which stays where it is.
TissueMap everyNth(const TissueMap& map, int n);

/// Returns `size` voxels, every n-th along each axis, starting from voxel `first`.
TissueMap everyNth(const TissueMap& map, int n, const std::array<int, 3>& first, const std::array<int, 3>& size);

/// Number of voxels of each label in the map, background included.
std::map<Label, std::size_t> countVoxels(const TissueMap& map);

} // namespace surgicalmesher
