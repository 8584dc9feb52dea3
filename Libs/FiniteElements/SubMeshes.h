// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Division of the mesh into children, the fine parts around the target, which a multirate solver advances at a higher
/// rate, and the parent, the rest (Audette et al., Computer Aided Surgery 12(1), 2007: a child consists of contiguous
/// tetrahedra whose edge lengths approach Lmin).

#include "SizingFunction.h"
#include "TetMesh.h"

namespace surgicalmesher
{

struct SubMeshOptions
{
  double tolerance = 0.25; ///< a tetrahedron is fine if L at its centroid is at most Lmin (1 + tolerance)
  /// Fine regions with fewer tetrahedra than this fraction of the largest one's become no children.
  double speckFraction = 0.02;
};

struct SubMeshes
{
  /// 0 parent, 1..n child; children in descending order of the size of their fine regions.
  std::vector<std::int32_t> ofTetrahedron;
  std::vector<std::int32_t> interfacePoints; ///< points where tetrahedra of several sub-meshes meet, ascending
  std::int32_t children = 0;
  std::vector<std::int32_t> pieces; ///< per sub-mesh, 0..n: number of face-connected pieces; 1 for every child
};

/// Divides the mesh. Lmin is the least L at the centroid of a tetrahedron. Children are face-connected. A piece of the
/// parent that a child separates from the parent's largest piece in the same body joins that child if it has fewer
/// tetrahedra; the parent is thus connected within each body, unless a child passes right through it. If every
/// tetrahedron is fine, as with a uniform scale, all belong to the parent.
SubMeshes divideIntoSubMeshes(const TetMesh& mesh, const SizingFunction& edgeLength,
                              const SubMeshOptions& options = {});

/// Returns the constitutive class of each tetrahedron: 1 (nonlinear) in children, 0 (linear) in the parent, 2 (null
/// displacement) in null-displacement tissue.
std::vector<std::int32_t> constitutiveModels(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh,
                                             const TissueTable& tissues);

} // namespace surgicalmesher
