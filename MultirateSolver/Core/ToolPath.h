// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the tip of a tool is, over time.

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

/// Reads a CSV whose header row names its columns seconds, x, y, z (mm, LPS), in any order. Throws InputError with file
/// and line for anything else than two rows or more of finite numbers, with ascending times.
ToolPath readToolPath(const std::string& file);

/// Straight from row to row, still before the first and after the last.
Vec3 tipAt(const ToolPath& path, double seconds);

} // namespace surgicalmesher
