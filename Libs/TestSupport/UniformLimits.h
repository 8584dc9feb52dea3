// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Limits that are the same everywhere.

#include "SimplexOperators.h"

namespace surgicalmesher::test
{

inline OperatorLimits limitsOf(double length, double proximity)
{
  OperatorLimits limits;
  limits.edgeLength = [=](const Vec3&) { return length; };
  limits.proximity = [=](const Vec3&) { return proximity; };
  return limits;
}

} // namespace surgicalmesher::test
