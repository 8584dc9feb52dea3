// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Meshes of voxel maps with tissues, sub-meshes and constitutive classes, for the tests of sets and exports.

#include "FaceAdjacency.h"
#include "MeshIO.h"
#include "RandomMaps.h"
#include "VoxelMesh.h"

namespace surgicalmesher::test
{

/// Up to four tissues in random boxes; child 1 where x < 3, nonlinear where y < 3, null displacement where z > 5 (mm).
inline MeshFile randomBlocks(unsigned seed)
{
  std::mt19937 random(seed);
  MeshFile content;
  content.mesh = withoutOutside(tetrahedraOf(randomWellComposedMap(random, { 6, 7, 8 }, 4)));
  for (const auto& [a, b, c, d] : content.mesh.tetrahedra)
  {
    const auto& p = content.mesh.points;
    const Vec3 centroid = 0.25 * (p[a] + p[b] + p[c] + p[d]);
    content.subMesh.push_back(centroid.x < 2.5);
    content.constitutive.push_back(centroid.z > 4.5 ? 2 : centroid.y < 2.5);
  }
  content.tissues[1] = { "Gray matter", { 1, 0, 0 }, {} };
  content.tissues[2] = { "Dura mater", { 0, 0.5, 0.25 }, {} };
  return content;
}

inline double volumeOf(const TetMesh& mesh, std::int32_t t)
{
  const auto& [a, b, c, d] = mesh.tetrahedra[t];
  return orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) / 6;
}

inline double volumeOf(const TetMesh& mesh, const std::vector<std::int32_t>& tetrahedra)
{
  double volume = 0;
  for (const std::int32_t t : tetrahedra) volume += volumeOf(mesh, t);
  return volume;
}

} // namespace surgicalmesher::test
