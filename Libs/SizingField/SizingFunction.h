// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Target edge length L(x) as a function of position.

#include "Vec3.h"

#include <functional>

namespace surgicalmesher
{

/// L(x), mm, positive, at a point (mm) of the frame that the user of the function works in.
using SizingFunction = std::function<double(const Vec3&)>;

} // namespace surgicalmesher
