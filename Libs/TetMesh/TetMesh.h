// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A labelled tetrahedral mesh as plain arrays, and the surface complex between its labels: the results that stages
/// pass on.

#include "TissueMap.h"
#include "Vec3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace surgicalmesher
{

/// Tetrahedra with one label each; positively wound: orient(a, b, c, d) > 0.
struct TetMesh
{
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 4>> tetrahedra; ///< point ids
  std::vector<Label> labels;                           ///< per tetrahedron; 0 outside
};

/// One triangle complex for all tissues; a face between two tissues exists once.
struct SurfaceComplex
{
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles; ///< point ids; normal by the right-hand rule
  std::vector<std::array<Label, 2>> labels;           ///< [behind, in front of the normal]; 0 outside
};

} // namespace surgicalmesher
