// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Bookkeeping of the cubes of voxels that must be examined again after changes of a map.

#include "BoundaryFaces.h"
#include "Parallel.h"
#include "TissueMap.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace surgicalmesher
{

class DirtyCubes
{
  static constexpr int side = 4;

public:
  explicit DirtyCubes(const Grid& grid) : m_Grid(grid)
  {
    for (int axis = 0; axis < 3; ++axis) m_Count[axis] = (grid.size[axis] + side - 1) / side;
    m_Changes.assign(std::size_t(m_Count[0]) * m_Count[1] * m_Count[2], 0);
  }

  /// Marks the cubes that hold a voxel with a face neighbour of another label, except in the outermost `margin` voxels.
  void markBoundary(const TissueMap& map, int margin)
  {
    const auto& size = m_Grid.size;
    parallelForEach(std::size_t(m_Count[2]),
                    [&](std::size_t slab)
                    {
                      const int from = std::max(margin, int(slab) * side);
                      const int to = std::min(size[2] - margin, (int(slab) + 1) * side);
                      const auto mark = [&](std::size_t voxel) { m_Changes[cubeOf(voxel)] = 1; };
                      for (int k = from; k < to; ++k)
                        for (int j = margin; j < size[1] - margin; ++j)
                          forEachBoundaryVoxel(map, j, k, margin, size[0] - margin, mark);
                    });
  }

  /// Marks the cubes that hold a voxel within `reach` steps, along each axis, of a box in which `changes` voxels
  /// changed. `first`, `last`: the box's lowest and highest voxel.
  void mark(const std::array<int, 3>& first, const std::array<int, 3>& last, int reach, std::size_t changes)
  {
    forEachNear(first, last, reach, [&](std::size_t cube) { m_Changes[cube] += std::uint32_t(changes); });
  }

  /// Calls visit(cube) for the cubes that hold a voxel within `reach` steps, along each axis, of a box.
  template <typename Visit>
  void forEachNear(const std::array<int, 3>& first, const std::array<int, 3>& last, int reach, const Visit& visit) const
  {
    std::array<int, 3> from, to;
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = std::max(0, first[axis] - reach) / side;
      to[axis] = std::min(m_Grid.size[axis] - 1, last[axis] + reach) / side;
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) visit((std::size_t(k) * m_Count[1] + j) * m_Count[0] + i);
  }

  std::size_t cubeOf(std::size_t voxel) const
  {
    const std::array<int, 3> at = m_Grid.voxelAt(voxel);
    return (std::size_t(at[2] / side) * m_Count[1] + at[1] / side) * m_Count[0] + at[0] / side;
  }

  struct Dirty
  {
    std::size_t cube;
    std::uint32_t changes; ///< upper bound on the changed voxels within reach of its voxels
  };

  /// Returns the dirty cubes, ascending, and makes all cubes clean.
  std::vector<Dirty> take()
  {
    std::vector<Dirty> cubes;
    for (std::size_t cube = 0; cube < m_Changes.size(); ++cube)
      if (m_Changes[cube] > 0) cubes.push_back({ cube, std::exchange(m_Changes[cube], 0) });
    return cubes;
  }

  static constexpr int voxels = side * side * side; ///< per cube

  /// Number of all cubes.
  std::size_t count() const { return m_Changes.size(); }

  /// Calls visit(voxel, number in the cube) for every voxel of a cube with a face neighbour of another label, except in
  /// the outermost `margin` voxels of the grid.
  template <typename Visit>
  void visitBoundary(const TissueMap& map, std::size_t cube, int margin, const Visit& visit) const
  {
    const std::array<int, 3> c{ int(cube % m_Count[0]), int(cube / m_Count[0] % m_Count[1]),
                                int(cube / m_Count[0] / m_Count[1]) };
    std::array<int, 3> from, to;
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = std::max(margin, c[axis] * side);
      to[axis] = std::min(m_Grid.size[axis] - margin, (c[axis] + 1) * side);
    }
    for (int k = from[2]; k < to[2]; ++k)
      for (int j = from[1]; j < to[1]; ++j)
      {
        const std::size_t first = m_Grid.index(c[0] * side, j, k);
        const int row = (k % side * side + j % side) * side;
        forEachBoundaryVoxel(map, j, k, from[0], to[0], [&](std::size_t v) { visit(v, row + int(v - first)); });
      }
  }

private:
  const Grid& m_Grid;
  std::array<int, 3> m_Count;
  std::vector<std::uint32_t> m_Changes; ///< by cube; 0 for clean ones
};

} // namespace surgicalmesher
