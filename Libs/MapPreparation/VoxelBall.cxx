// SPDX-License-Identifier: Apache-2.0
#include "VoxelBall.h"

#include <numeric>

namespace surgicalmesher
{

VoxelBall::VoxelBall(const Grid& grid, double radius)
{
  const Vec3& s = grid.spacing;
  const int reachJ = int(radius / s.y), reachK = int(radius / s.z);
  for (int k = -reachK; k <= reachK; ++k)
    for (int j = -reachJ; j <= reachJ; ++j)
    {
      int past = 0;
      while (squaredNorm({ past * s.x, j * s.y, k * s.z }) <= radius * radius) ++past;
      if (past > 0) addRow((std::ptrdiff_t(k) * grid.size[1] + j) * grid.size[0], past - 1);
    }
}

/// Adds the voxels from -reach to reach along i, in the row whose middle is `step` from the ball's middle.
void VoxelBall::addRow(std::ptrdiff_t step, int reach)
{
  for (int from = -reach; from <= reach; from += width)
  {
    Row row{ step + from, {} };
    for (int i = 0; i < width; ++i) row.belongs[i] = from + i <= reach;
    m_Rows.push_back(row);
  }
  m_Size += 2 * reach + 1;
}

std::size_t VoxelBall::count(const Label* middle, Label label) const
{
  // gcc 12 vectorises two separate loops over C arrays to a few instructions on eight numbers each. As one loop, over
  // std::array, or inlined into a caller, they stay scalar, which takes twice as long.
  std::uint16_t sums[width] = {}, same[width];
  for (const Row& row : m_Rows)
  {
    const Label* const labels = middle + row.step;
    for (int i = 0; i < width; ++i) same[i] = labels[i] == label ? 0xffff : 0;
    for (int i = 0; i < width; ++i) sums[i] = std::uint16_t(sums[i] + (same[i] & row.belongs[i]));
  }
  return std::accumulate(sums, sums + width, std::size_t(0));
}

} // namespace surgicalmesher
