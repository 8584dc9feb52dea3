// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Position of a tool's tip over time.

#include "Vec3.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

struct ToolPath
{
  std::vector<double> seconds; ///< ascending
  std::vector<Vec3> tips;      ///< mm, LPS
};

/// Reads a CSV whose header row names the columns seconds, x, y, z (mm, LPS), in any order. Throws InputError with file
/// and line unless there are two or more rows of finite numbers with ascending times.
ToolPath readToolPath(const std::string& file);

/// Returns the position at a time: linear between rows, constant before the first and after the last.
Vec3 tipAt(const ToolPath& path, double seconds);

} // namespace surgicalmesher
