// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Vessels and nerves along edges of a mesh.

#include <cstdint>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// A curve along edges of a mesh.
struct CurveChain
{
  std::string name;
  std::vector<std::int32_t> points; ///< point ids, along the curve; a closed one ends with its first point
  std::vector<double> radii;        ///< at each point, mm; 0: not given
};

} // namespace surgicalmesher
