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

/// The grid seen from its own grid frame: origin 0, axes along x, y, z. Spacing is rounded as below.
Grid inOwnFrame(const Grid& grid);

/// The same lengths seen from the grid frame of `frame`. Placement is rounded to 1e-6 mm, more than headers in single
/// precision hold: map and scale then give the same numbers, bit by bit, as copies of both that lie elsewhere.
ScaleField inFrameOf(const Grid& frame, const ScaleField& scale);

/// A world position seen from the grid frame of `frame`, rounded likewise.
Vec3 inFrameOf(const Grid& frame, const Vec3& world);

/// One length everywhere.
ScaleField uniformScale(double edgeLength);

} // namespace surgicalmesher
