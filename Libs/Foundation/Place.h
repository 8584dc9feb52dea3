// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers and points as messages name them.

#include "Vec3.h"

#include <locale>
#include <sstream>
#include <string>

namespace surgicalmesher
{

/// To that many significant digits, with a point whatever the locale.
inline std::string rounded(double value, int digits = 3)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(digits);
  text << value;
  return text.str();
}

/// "(1.5, -2, 30) mm".
inline std::string place(const Vec3& point, int digits = 6)
{
  return "(" + rounded(point.x, digits) + ", " + rounded(point.y, digits) + ", " + rounded(point.z, digits) + ") mm";
}

} // namespace surgicalmesher
