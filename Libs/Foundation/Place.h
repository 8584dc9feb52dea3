// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A point as messages name it.

#include "Vec3.h"

#include <sstream>
#include <string>

namespace surgicalmesher
{

/// "(1.5, -2, 30) mm", six digits.
inline std::string place(const Vec3& point)
{
  std::ostringstream text;
  text.precision(6);
  text << "(" << point.x << ", " << point.y << ", " << point.z << ") mm";
  return text.str();
}

} // namespace surgicalmesher
