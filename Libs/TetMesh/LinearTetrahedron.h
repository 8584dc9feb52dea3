// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Linear shape functions on a tetrahedron, and its stiffness in linear elasticity.

#include "FaceAdjacency.h"

namespace surgicalmesher
{

/// Gradients of the four barycentric coordinates, 1/mm, and the volume, mm^3.
struct LinearTetrahedron
{
  std::array<Vec3, 4> gradients;
  double volume = 0;
};

inline LinearTetrahedron linearTetrahedron(const std::array<Vec3, 4>& p)
{
  const double sixVolumes = orient(p[0], p[1], p[2], p[3]);
  LinearTetrahedron result;
  result.volume = sixVolumes / 6;
  for (int f = 0; f < 4; ++f)
  {
    const auto& [i, j, k] = kFaceCorners[f];
    result.gradients[f] = cross(p[j] - p[i], p[k] - p[i]) / -sixVolumes;
  }
  return result;
}

inline std::array<Vec3, 4> cornersOf(const TetMesh& mesh, std::size_t t)
{
  const auto& [a, b, c, d] = mesh.tetrahedra[t];
  return { mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d] };
}

/// Lame's constants, in the unit of Young's modulus.
struct LameConstants
{
  double lambda, mu;
};

inline LameConstants lameConstants(double youngsModulus, double poissonsRatio)
{
  return { youngsModulus * poissonsRatio / ((1 + poissonsRatio) * (1 - 2 * poissonsRatio)),
           0.5 * youngsModulus / (1 + poissonsRatio) };
}

/// A 3x3 block of the stiffness matrix, row by row: rows are the force on one corner, columns the displacement of
/// another, in [x, y, z]; N/mm for moduli in MPa.
using StiffnessBlock = std::array<double, 9>;

/// The block of the force on corner a and the displacement of corner b, in linear elasticity.
inline StiffnessBlock stiffnessBlock(const LinearTetrahedron& tetrahedron, int a, int b, const LameConstants& lame)
{
  const Vec3 &g = tetrahedron.gradients[a], &h = tetrahedron.gradients[b];
  const double shear = lame.mu * dot(g, h);
  StiffnessBlock block;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      block[3 * i + j] =
        tetrahedron.volume * (lame.lambda * g[i] * h[j] + lame.mu * g[j] * h[i] + (i == j ? shear : 0));
  return block;
}

} // namespace surgicalmesher
