// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Vec3.h"

#include <array>
#include <string>

namespace surgicalmesher
{

/// An affine map of space.
struct LinearMap
{
  std::array<Vec3, 3> rows{ Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } };
  Vec3 offset; ///< mm

  Vec3 operator()(const Vec3& p) const { return Vec3{ dot(rows[0], p), dot(rows[1], p), dot(rows[2], p) } + offset; }
};

/// Writes an Insight transform file (.tfm, .txt) of an ITK AffineTransform, LPS. Applied in Slicer, it moves an image
/// from the space of the map's results to the space of its arguments. Throws InputError if the file cannot be written
/// in full.
void writeTransform(const LinearMap& map, const std::string& file);

} // namespace surgicalmesher
