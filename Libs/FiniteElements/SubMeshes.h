// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Child and parent: the fine part of the mesh around the target, which a multirate solver advances at a higher rate,
/// and the rest (Audette et al., Computer Aided Surgery 12(1), 2007: contiguous tetrahedra whose edge lengths approach
/// Lmin are a child).

#include "SizingFunction.h"
#include "TetMesh.h"

namespace surgicalmesher
{

struct SubMeshOptions
{
  double tolerance = 0.25;     ///< a tetrahedron is fine if L at its centre is at most Lmin (1 + tolerance)
  double speckFraction = 0.02; ///< fine regions with fewer tetrahedra than this share of the largest one's are no child
};

struct SubMeshes
{
  std::vector<std::int32_t> ofTetrahedron;   ///< 0 parent, 1..n child; children in descending order of size
  std::vector<std::int32_t> interfacePoints; ///< points where tetrahedra of several sub-meshes meet, ascending
  std::int32_t children = 0;
  std::vector<std::int32_t> pieces; ///< per sub-mesh, 0..n: face-connected pieces; 1 for every child
};

/// Divides the mesh. Lmin is the least L at the centre of a tetrahedron. Children are face-connected. Pieces of the
/// parent that a child cuts off from the parent's largest piece in the same body, and that have fewer tetrahedra than
/// that child, join it; so the parent is connected within each body, unless a child passes right through it. If every
/// tetrahedron is fine, as under a uniform scale, no part is finer than another and all are parent.
SubMeshes divideIntoSubMeshes(const TetMesh& mesh, const SizingFunction& edgeLength,
                              const SubMeshOptions& options = {});

/// Constitutive model of each tetrahedron: 1 (nonlinear) in children, 0 (linear) in the parent, 2 (null displacement)
/// in null-displacement tissue.
std::vector<std::int32_t> constitutiveModels(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh,
                                             const TissueTable& tissues);

} // namespace surgicalmesher
