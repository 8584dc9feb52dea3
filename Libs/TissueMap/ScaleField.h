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

/// One length everywhere.
ScaleField uniformScale(double edgeLength);

} // namespace surgicalmesher
