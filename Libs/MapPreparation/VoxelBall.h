// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Counting of labels in the ball around a voxel.

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
  /// The ball of the voxels of `grid` whose centres are at most `radius` (mm) from that of the middle voxel.
  VoxelBall(const Grid& grid, double radius);

  /// Number of voxels.
  std::size_t size() const { return m_Size; }

  /// Returns how many voxels of the ball have this label. `middle` points to the label of the middle voxel in a map of
  /// that grid. Up to seven labels after the ball's last are read, so the ball must end before the map's last row.
  std::size_t count(const Label* middle, Label label) const;

private:
  /// Number of voxels along i that are compared at once; at the end of a row, some of them may lie outside the ball.
  static constexpr int width = 8;
  struct Row
  {
    std::ptrdiff_t step; ///< memory offset of the first voxel from the middle one
    std::array<std::uint16_t, width> belongs;
  };

  void addRow(std::ptrdiff_t step, int reach);

  std::vector<Row> m_Rows;
  std::size_t m_Size = 0;
};

} // namespace surgicalmesher
