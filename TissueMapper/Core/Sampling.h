// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Interpolation of a voxel field. Positions are in the grid frame (mm); beyond the grid the field is constant, as at
/// its border.

#include "Grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Continuous voxel indices of a position in the grid frame.
inline Vec3 toIndex(const Grid& grid, const Vec3& p)
{
  return { p.x / grid.spacing.x, p.y / grid.spacing.y, p.z / grid.spacing.z };
}

/// The voxel nearest to a position in the grid frame; positions off the grid are clamped to it.
inline std::array<int, 3> nearestVoxel(const Grid& grid, const Vec3& p)
{
  std::array<int, 3> voxel;
  const Vec3 index = toIndex(grid, p);
  for (int axis = 0; axis < 3; ++axis)
    voxel[axis] = int(std::lround(std::clamp(index[axis], 0.0, double(grid.size[axis] - 1))));
  return voxel;
}

inline Vec3 voxelCentre(const Grid& grid, const std::array<int, 3>& voxel)
{
  return { voxel[0] * grid.spacing.x, voxel[1] * grid.spacing.y, voxel[2] * grid.spacing.z };
}

/// Whether a position in the grid frame lies in the volume that the voxels cover.
inline bool isInVolume(const Grid& grid, const Vec3& p)
{
  const Vec3 index = toIndex(grid, p);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(index[axis] >= -0.5 && index[axis] <= grid.size[axis] - 0.5)) return false;
  }
  return true;
}

/// Throws InputError unless the grid has at least `least` voxels along each axis; `purpose` says what they are for.
void requireVoxels(const Grid& grid, int least, const std::string& purpose);

/// Edge length (mm) of a cube with the volume of a voxel.
inline double voxelLength(const Grid& grid) { return std::cbrt(grid.spacing.x * grid.spacing.y * grid.spacing.z); }

/// Trilinear interpolation.
double linearValue(const Grid& grid, const std::vector<float>& values, const Vec3& p);

/// Catmull-Rom cubic interpolation along each axis.
double cubicValue(const Grid& grid, const std::vector<float>& values, const Vec3& p);

} // namespace surgicalmesher
