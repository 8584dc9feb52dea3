// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Linear maps of space.

#include "Vec3.h"

#include <array>
#include <string>

namespace surgicalmesher
{

struct LinearMap
{
  std::array<Vec3, 3> rows{ Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } };
  Vec3 offset; ///< mm

  Vec3 operator()(const Vec3& p) const { return Vec3{ dot(rows[0], p), dot(rows[1], p), dot(rows[2], p) } + offset; }
};

/// An Insight transform file (.tfm, .txt) of ITK's AffineTransform: what Slicer applies to move an image from the world
/// of `map`'s results to that of its arguments. LPS. Throws InputError if it can't be written whole.
void writeTransform(const LinearMap& map, const std::string& file);

} // namespace surgicalmesher
