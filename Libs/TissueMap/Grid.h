// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A regular voxel grid in space: where voxel (i, j, k) lies.
///
/// Two frames appear in the project. *World* is the frame of the files (LPS, mm). The *grid frame* has its origin at
/// the centre of voxel (0, 0, 0), its axes along i, j, k, and millimetres as its unit. The two differ by a rotation and
/// a translation only, so lengths, angles and the sign of volumes agree. All meshing is done in the grid frame of the
/// tissue map: a map and its rotated copy then give the same mesh, to rounding, in their own worlds.

#include "Vec3.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace surgicalmesher
{

struct Grid
{
  std::array<int, 3> size{ 0, 0, 0 }; ///< voxels along i, j, k; i runs fastest in memory
  Vec3 spacing{ 1, 1, 1 };            ///< mm
  Vec3 origin;                        ///< world position of the centre of voxel (0, 0, 0), mm
  std::array<Vec3, 3> axes{ Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 },
                            Vec3{ 0, 0, 1 } }; ///< unit world directions of i, j, k; right-handed

  std::size_t voxelCount() const { return std::size_t(size[0]) * size[1] * size[2]; }
  std::size_t index(int i, int j, int k) const { return (std::size_t(k) * size[1] + j) * size[0] + i; }
  bool contains(int i, int j, int k) const
  {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }

  double smallestSpacing() const { return std::min({ spacing.x, spacing.y, spacing.z }); } ///< mm
  double largestSpacing() const { return std::max({ spacing.x, spacing.y, spacing.z }); }  ///< mm

  /// The voxel that lies at `index` in memory.
  std::array<int, 3> voxelAt(std::size_t index) const
  {
    const std::size_t row = index / size[0];
    return { int(index % size[0]), int(row % size[1]), int(row / size[1]) };
  }
  /// Centre of a voxel in the grid frame, mm.
  Vec3 position(int i, int j, int k) const { return { i * spacing.x, j * spacing.y, k * spacing.z }; }

  Vec3 gridToWorld(const Vec3& p) const { return origin + p.x * axes[0] + p.y * axes[1] + p.z * axes[2]; }
  Vec3 worldToGrid(const Vec3& p) const
  {
    const Vec3 d = p - origin;
    return { dot(d, axes[0]), dot(d, axes[1]), dot(d, axes[2]) };
  }
};

} // namespace surgicalmesher
