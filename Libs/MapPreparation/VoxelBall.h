// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Counts labels in the ball around a voxel.

#include "TissueMap.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace surgicalmesher
{

class VoxelBall
{
public:
  /// Of the voxels of `grid` whose centres are at most `radius` (mm) from the one in the middle.
  VoxelBall(const Grid& grid, double radius);

  /// Number of voxels.
  std::size_t size() const { return m_Size; }

  /// How many of them have this label; `middle` points to the label of the one in the middle, in a map of that grid. Up
  /// to seven labels after the ball's last are read, so the ball must end before the map's last row.
  std::size_t count(const Label* middle, Label label) const;

private:
  /// Eight voxels along i, which are compared at once; those at the end of a row of the ball need not belong to it.
  static constexpr int width = 8;
  struct Row
  {
    std::ptrdiff_t step; ///< from the middle to the first
    std::array<std::uint16_t, width> belongs;
  };

  void addRow(std::ptrdiff_t step, int reach);

  std::vector<Row> m_Rows;
  std::size_t m_Size = 0;
};

} // namespace surgicalmesher
