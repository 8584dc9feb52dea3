// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two tissues and a groove between them on the outer surface.

#include "ComplexInvariants.h"
#include "VoxelMesh.h"

#include <cmath>

namespace surgicalmesher::test
{

/// Two tissues, one a wall beside the other's flat top, and leaning over it by so many degrees: along the seam, at x = z =
/// 2.5, normals turn by 90 degrees and as many more.
inline TetComplex groove(double degrees, float tolerance = 0.5f)
{
  constexpr double degree = 3.14159265358979323846 / 180;
  TetMesh mesh = tetrahedraOf(paintedMap({ 6, 6, 6 }, [](int i, int, int k) { return i < 3 ? 2 : k < 3 ? 1 : 0; }));
  for (Vec3& p : mesh.points) p.x += std::tan(degrees * degree) * (p.z - 2.5);
  return complexOf(mesh, 1, tolerance);
}

} // namespace surgicalmesher::test
