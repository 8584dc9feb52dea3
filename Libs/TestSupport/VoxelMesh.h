// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Test shapes from voxels: maps painted by a function, and tetrahedra of a map.

#include "TetMesh.h"
#include "TissueMap.h"

#include <algorithm>
#include <array>
#include <functional>

namespace surgicalmesher::test
{

/// A map of the given size whose voxel (i, j, k) has the label paint(i, j, k).
inline TissueMap paintedMap(const std::array<int, 3>& size, const std::function<int(int i, int j, int k)>& paint,
                            const Vec3& spacing = { 1, 1, 1 })
{
  TissueMap map;
  map.grid.size = size;
  map.grid.spacing = spacing;
  map.labels.resize(map.grid.voxelCount());
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i) map.labels[map.grid.index(i, j, k)] = static_cast<Label>(paint(i, j, k));
    }
  }
  return map;
}

/// Six tetrahedra per voxel around its diagonal (Kuhn), in the grid frame, with `ring` layers of background around the
/// map. Every dihedral angle of a cubic voxel's tetrahedra is 45, 60 or 90 degrees.
inline TetMesh tetrahedraOf(const TissueMap& map, int ring = 1)
{
  const Grid& grid = map.grid;
  const std::array<int, 3> size{ grid.size[0] + 2 * ring, grid.size[1] + 2 * ring, grid.size[2] + 2 * ring };
  const auto corner = [&](int i, int j, int k) { return (k * (size[1] + 1) + j) * (size[0] + 1) + i; };
  TetMesh mesh;
  for (int k = 0; k <= size[2]; ++k)
  {
    for (int j = 0; j <= size[1]; ++j)
    {
      for (int i = 0; i <= size[0]; ++i)
      {
        mesh.points.push_back(
          { (i - ring - 0.5) * grid.spacing.x, (j - ring - 0.5) * grid.spacing.y, (k - ring - 0.5) * grid.spacing.z });
      }
    }
  }
  const auto addVoxel = [&](int i, int j, int k, Label label)
  {
    std::array<int, 3> axes{ 0, 1, 2 };
    do {
      std::array<int, 3> at{ i, j, k };
      std::array<std::int32_t, 4> tetrahedron{ corner(i, j, k) };
      for (int step = 0; step < 3; ++step)
      {
        ++at[axes[step]];
        tetrahedron[step + 1] = corner(at[0], at[1], at[2]);
      }
      const bool even = (axes[0] + 1) % 3 == axes[1];
      if (!even) std::swap(tetrahedron[1], tetrahedron[2]);
      mesh.tetrahedra.push_back(tetrahedron);
      mesh.labels.push_back(label);
    } while (std::next_permutation(axes.begin(), axes.end()));
  };
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        const bool inside = grid.contains(i - ring, j - ring, k - ring);
        addVoxel(i, j, k, inside ? map.labels[grid.index(i - ring, j - ring, k - ring)] : Label(0));
      }
    }
  }
  return mesh;
}

} // namespace surgicalmesher::test
