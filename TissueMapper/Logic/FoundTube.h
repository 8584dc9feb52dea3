// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Result of tracing a tube, as reported by TubePathCLI; lengths in mm.
struct FoundTube
{
  bool isBright = false;
  double length = 0;
  double smallestRadius = 0;
  double largestRadius = 0;
  std::vector<std::string> warnings;
};

} // namespace surgicalmesher
