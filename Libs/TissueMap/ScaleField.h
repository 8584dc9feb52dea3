// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Target edge length L(x) over space, read from a scale volume with linear interpolation.

#include "Grid.h"

#include <vector>

namespace surgicalmesher
{

struct ScaleField
{
  Grid grid;
  std::vector<float> lengths; ///< grid.voxelCount() edge lengths, mm, all finite and > 0; i fastest

  /// L in mm at a world position; beyond the volume, the value at the nearest point of it.
  double operator()(const Vec3& world) const;
};

/// The grid seen from its own grid frame: origin 0, axes along x, y, z. Its spacing is rounded as by inFrameOf().
Grid inOwnFrame(const Grid& grid);

/// Returns the scale in the grid frame of `frame`. Its placement is rounded to 1e-6 mm, finer than headers in single
/// precision resolve: a map and its scale then give bitwise the same numbers as copies of both that lie elsewhere.
ScaleField inFrameOf(const Grid& frame, const ScaleField& scale);

/// Returns a world position in the grid frame of `frame`, rounded likewise.
Vec3 inFrameOf(const Grid& frame, const Vec3& world);

/// A scale of one length (mm) everywhere, stored as a single voxel.
ScaleField uniformScale(double edgeLength);

} // namespace surgicalmesher
