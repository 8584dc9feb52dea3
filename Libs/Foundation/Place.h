// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A point as messages name it.

#include "Text.h"
#include "Vec3.h"

namespace surgicalmesher
{

/// "(1.5, -2, 30) mm".
inline std::string place(const Vec3& point, int digits = 6)
{
  const auto number = [&](double value) { return text::rounded(value, digits); };
  return "(" + number(point.x) + ", " + number(point.y) + ", " + number(point.z) + ") mm";
}

} // namespace surgicalmesher
