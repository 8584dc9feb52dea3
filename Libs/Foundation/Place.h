// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points in messages.

#include "Text.h"
#include "Vec3.h"

namespace surgicalmesher
{

/// Returns "(1.5, -2, 30) mm", with `digits` significant digits.
inline std::string place(const Vec3& point, int digits = 6)
{
  const auto number = [&](double value) { return text::rounded(value, digits); };
  return "(" + number(point.x) + ", " + number(point.y) + ", " + number(point.z) + ") mm";
}

} // namespace surgicalmesher
