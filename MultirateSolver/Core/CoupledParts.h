// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A mesh divided into a parent and children, as systems of equations that share points.

#include "Elasticity.h"
#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Parent and children together.
struct CoupledMesh
{
  ElasticBody whole;                        ///< every point of parent and children once
  std::vector<std::int32_t> part;           ///< per tetrahedron: 0 parent, 1..n child
  std::int32_t children = 0;                ///< in descending order of size
  std::vector<std::int32_t> volumePointIds; ///< per point, ascending: its id in the mesh that was divided
};

/// Joins the files of FuchsTetrahedralizerCLI --parentMesh and --childMesh by VolumePointId; the child's file is as many
/// children as it has face-connected pieces. Held are the points of null displacement, or, without any, the lowest
/// twentieth (LPS) of the points that are the parent's alone. Tissues without a row in `materials` have the default
/// material. Throws InputError if a file has no VolumePointId, the two share no point, or share one at different places.
CoupledMesh coupledMesh(const MeshFile& parent, const MeshFile& child,
                        const std::map<Label, TissueMaterial>& materials);

/// One of the systems, or several of them taken together.
struct Part
{
  ElasticBody body;
  std::vector<std::int32_t> points; ///< per point: its number in the whole
};

Part partOf(const CoupledMesh& mesh, const std::vector<bool>& parts);

/// The unknowns that two parts share, by their numbers in each, in the same order.
struct Interface
{
  std::vector<std::int32_t> first, second;
};
Interface interfaceOf(const Part& first, const Part& second);

} // namespace surgicalmesher
