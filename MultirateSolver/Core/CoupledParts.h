// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Division of a mesh into a parent and children: systems of equations that share points.

#include "Elasticity.h"
#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Parent and children in one mesh.
struct CoupledMesh
{
  ElasticBody whole;                        ///< every point of parent and children once
  std::vector<std::int32_t> part;           ///< per tetrahedron: 0 for the parent, 1..n for a child
  std::int32_t children = 0;                ///< number of children, in descending order of size
  std::vector<std::int32_t> volumePointIds; ///< per point, ascending: its id in the mesh before the division
};

/// Joins the files of FuchsTetrahedralizerCLI --parentMesh and --childMesh by VolumePointId. Each face-connected
/// component of the child's file becomes a child. Points of null-displacement tetrahedra are held fixed; without any,
/// the lowest twentieth (LPS) of the points that belong to the parent only. Tissues without a row in `materials` get
/// the default material. Throws InputError if a file has no VolumePointId, or if the two share no point, or share one
/// at different positions.
CoupledMesh coupledMesh(const MeshFile& parent, const MeshFile& child,
                        const std::map<Label, TissueMaterial>& materials);

/// The system of one part, or of several parts together.
struct Part
{
  ElasticBody body;
  std::vector<std::int32_t> points; ///< per point: its number in the whole mesh
};

/// Returns the system of the parts whose flag is set; `parts` is indexed like CoupledMesh::part.
Part partOf(const CoupledMesh& mesh, const std::vector<bool>& parts);

/// The unknowns that two parts share, by their numbers in each, in the same order.
struct Interface
{
  std::vector<std::int32_t> first, second;
};
Interface interfaceOf(const Part& first, const Part& second);

} // namespace surgicalmesher
