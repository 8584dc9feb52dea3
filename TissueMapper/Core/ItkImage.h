// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conversion between voxel fields and ITK images.

#include "Grid.h"

#include <itkImage.h>

#include <algorithm>
#include <vector>

namespace surgicalmesher
{

using ItkImage = itk::Image<float, 3>;

/// The grid in its own frame: the origin at the centre of voxel (0, 0, 0), no rotation.
inline Grid inGridFrame(const Grid& grid)
{
  Grid result;
  result.size = grid.size;
  result.spacing = grid.spacing;
  return result;
}

/// Returns an ITK image with a copy of the values, in the grid's position in the world.
template <typename Image, typename Values>
typename Image::Pointer asItkImage(const Grid& grid, const Values& values)
{
  const auto result = Image::New();
  typename Image::SizeType size;
  typename Image::SpacingType spacing;
  typename Image::PointType origin;
  typename Image::DirectionType direction;
  for (int axis = 0; axis < 3; ++axis)
  {
    size[axis] = grid.size[axis];
    spacing[axis] = grid.spacing[axis];
    origin[axis] = grid.origin[axis];
    for (int row = 0; row < 3; ++row) direction(row, axis) = grid.axes[axis][row];
  }
  result->SetRegions(typename Image::RegionType(size));
  result->SetSpacing(spacing);
  result->SetOrigin(origin);
  result->SetDirection(direction);
  result->Allocate();
  std::copy(values.begin(), values.end(), result->GetBufferPointer());
  return result;
}

inline std::vector<float> valuesOf(const ItkImage& image)
{
  const float* values = image.GetBufferPointer();
  return { values, values + image.GetBufferedRegion().GetNumberOfPixels() };
}

} // namespace surgicalmesher
