// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A mesh as solvers see it: named sets of elements, nodes and faces, materials, shells. Every export is written from
/// this and from nothing else.
///
/// Ids of points and tetrahedra count from 0, as in the mesh; formats that count from 1 add 1. Lengths in mm, LPS.
/// Units of materials are consistent with that: N, tonne, s, hence MPa and tonne/mm^3.

#include "MeshIO.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// What a set stands for, and what its `ids` are.
enum class SetKind
{
  Tissue,           ///< elements; [label]
  SubMesh,          ///< elements; [0 parent, 1..n child]
  Constitutive,     ///< elements; [0 linear, 1 nonlinear, 2 null displacement]
  TissueMaterial,   ///< elements of a tissue with one material, where it has two; [label, constitutive class]
  OuterBoundary,    ///< faces and nodes of the whole mesh's boundary; []
  TissueInterface,  ///< faces: [label behind, label in front]; nodes: [higher label, lower label]; 0 is outside
  SubMeshInterface, ///< likewise between sub-meshes; nodes where any sub-meshes meet: []
  NullDisplacement, ///< nodes of null-displacement elements; []
  Shell             ///< triangles; [label] or [label, neighbour]
};

/// The name of a kind in sidecars: "tissue", "subMesh", "constitutive", "tissueMaterial", "outerBoundary",
/// "tissueInterface", "subMeshInterface", "nullDisplacement", "shell".
std::string nameOf(SetKind kind);

/// What sets of all sorts have in common.
struct SetInfo
{
  std::string name;     ///< in files; unique among all sets and materials, see SetNames.h
  std::string original; ///< for people: a tissue's own name, or the two of an interface with " | " between
  SetKind kind{};
  std::vector<std::int32_t> ids;                ///< see SetKind
  std::array<double, 3> color{ 0.8, 0.8, 0.8 }; ///< RGB in [0, 1]: of the (first) tissue
};

struct ElementSet : SetInfo
{
  std::vector<std::int32_t> tetrahedra; ///< ascending
};

struct NodeSet : SetInfo
{
  std::vector<std::int32_t> points; ///< ascending
};

/// A side of a tetrahedron: `face` is the number of the corner opposite to it (see kFaceCorners).
struct TetrahedronFace
{
  std::int32_t tetrahedron;
  std::int32_t face;
};

/// An oriented surface. An interface between a and b is two such sets, one of a's tetrahedra and one of b's, with the
/// same triangles in the same order and opposite winding; the one with the higher id behind comes first.
struct SurfaceSet : SetInfo
{
  std::vector<TetrahedronFace> faces;
  std::vector<std::array<std::int32_t, 3>> triangles; ///< the same faces as point ids, wound out of their tetrahedra
  std::string nodeSet;                                ///< name of the set of its points
};

/// What the elements of a material do under load.
enum class MaterialLaw
{
  LinearElastic,
  NeoHookean
};

struct Material
{
  std::string name; ///< as SetInfo::name
  MaterialLaw law = MaterialLaw::LinearElastic;
  double youngsModulus = 0; ///< MPa
  double poissonsRatio = 0;
  double density = 0; ///< tonne/mm^3
};

/// A set of elements and the material they are made of.
struct Section
{
  std::int32_t elementSet; ///< index into FiniteElementModel::elementSets
  std::int32_t material;   ///< index into FiniteElementModel::materials
};

/// Triangles on faces of the mesh, wound out of the tissue.
struct Shell : SetInfo
{
  std::vector<std::array<std::int32_t, 3>> triangles; ///< point ids of the mesh
  double thickness = 0;                               ///< mm
  std::int32_t material = 0;                          ///< index into FiniteElementModel::materials
};

struct FiniteElementModel
{
  MeshFile
    content; ///< points, tetrahedra, labels and the arrays that travel with them; subMesh and constitutive filled
  std::vector<ElementSet> elementSets; ///< by kind: tissues, sub-meshes, constitutive classes, tissue materials
  std::vector<SurfaceSet> surfaces;    ///< outer boundary, tissue interfaces (outside included), sub-mesh interfaces
  std::vector<NodeSet> nodeSets;       ///< in the same order, then null displacement; one per interface, not per side
  std::vector<Material> materials;
  std::vector<Section> sections; ///< every tetrahedron belongs to exactly one
  std::vector<Shell> shells;     ///< no face belongs to two
};

/// A tissue's row of a material table, or what tissues without one have.
struct TissueMaterial
{
  MaterialLaw nonlinearLaw =
    MaterialLaw::NeoHookean;    ///< where tetrahedra are tagged nonlinear; elsewhere linear elastic
  double youngsModulus = 0.003; ///< MPa; the default is of soft tissue
  double poissonsRatio = 0.45;
  double density = 1e-9; ///< tonne/mm^3
};

/// A tissue whose boundary becomes a shell.
struct ShellChoice
{
  Label label = 0;
  std::int32_t neighbour = -1; ///< only where it touches this label (0: outside); -1: all around
  double thickness = 1;        ///< mm
};

struct FiniteElementOptions
{
  std::map<Label, TissueMaterial> materials; ///< tissues not listed share the material `default_material`
  std::vector<ShellChoice> shells;           ///< a face that several ask for belongs to the first
};

/// Sets, sections and shells of a mesh without label 0, as requireSound() wants it. An empty `subMesh` or
/// `constitutive` stands for zeros. Throws InputError for a shell of a tissue that isn't there, or without a single
/// face.
FiniteElementModel finiteElementModel(const MeshFile& content, const FiniteElementOptions& options = {});

/// The sets by name as JSON: what a sidecar file holds. Format in Docs/FuchsTetrahedralizer.md.
std::string setNamesJSON(const FiniteElementModel& model);

} // namespace surgicalmesher
