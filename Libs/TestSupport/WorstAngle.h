// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MeshQuality.h"

#include <algorithm>

namespace surgicalmesher::test
{

/// Returns the worst dihedral angle of the tissues, degrees; 150 counts as 30.
inline double worstAngle(const TetMesh& mesh)
{
  double worst = 90;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    if (mesh.labels[t] == 0) continue;
    for (double angle : dihedralAngles(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]))
      worst = std::min({ worst, angle, 180 - angle });
  }
  return worst;
}

} // namespace surgicalmesher::test
