// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A mesh as solvers see it: named sets of elements, nodes and faces, materials, shells. Every export is written from
/// this and from nothing else.
///
/// Ids of points and elements count from 0, as in the mesh; formats that count from 1 add 1. Lengths in mm, LPS.
/// Units of materials are consistent with that: N, tonne, s, hence MPa and tonne/mm^3. Units.h makes SI units of them.

#include "Cell.h"
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
  Shell,            ///< faces; [label] or [label, neighbour]
  Beam,             ///< edges; [curve, section], both from 1
  Named             ///< elements, nodes or faces by a name that came with the mesh; []
};

/// The name of a kind in sidecars: "tissue", "subMesh", "constitutive", "tissueMaterial", "outerBoundary",
/// "tissueInterface", "subMeshInterface", "nullDisplacement", "shell", "beam",
/// "named".
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
  std::vector<std::int32_t> elements; ///< ascending
};

struct NodeSet : SetInfo
{
  std::vector<std::int32_t> points; ///< ascending
};

/// An oriented surface. An interface between a and b is two such sets, one of a's elements and one of b's, with the
/// same faces in the same order and opposite winding; the one with the higher id behind comes first.
struct SurfaceSet : SetInfo
{
  std::vector<ElementFace> faces;
  std::vector<Cell> cells; ///< the same faces as point ids, wound out of their elements
  std::string nodeSet;     ///< name of the set of its points
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

/// Faces of the mesh, wound out of the tissue.
struct Shell : SetInfo
{
  std::vector<Cell> cells;   ///< point ids of the mesh
  double thickness = 0;      ///< mm
  std::int32_t material = 0; ///< index into FiniteElementModel::materials
};

/// Edges of the mesh along a curve, beams or trusses of one round section.
struct Beam : SetInfo
{
  std::vector<Cell> edges;   ///< point ids of the mesh, along the curve
  double radius = 0;         ///< mm
  bool isTruss = false;      ///< resists stretch alone
  std::int32_t material = 0; ///< index into FiniteElementModel::materials
};

/// Of the round section, in the square and the fourth power of the radius's unit.
double sectionArea(const Beam& beam);
double secondMomentOfArea(const Beam& beam);

/// The axis of the world that is most across an edge: what its section is turned to, where a solver asks for that.
Vec3 axisAcross(const Cell& edge, const std::vector<Vec3>& points);

/// What all numbers of a model are in.
enum class Units
{
  Millimetres, ///< mm, N, MPa, tonne, s
  SI           ///< m, N, Pa, kg, s
};

struct FiniteElementModel
{
  Units units = Units::Millimetres;
  /// Points, labels and the arrays that travel with them; subMesh and constitutive filled. Of a SolidMesh without its
  /// elements.
  MeshFile content;
  std::vector<Cell> elements;          ///< of any shape
  std::vector<ElementSet> elementSets; ///< by kind: tissues, sub-meshes, constitutive classes, named, tissue materials
  std::vector<SurfaceSet> surfaces;    ///< outer boundary, interfaces of tissues (and outside), of sub-meshes, named
  std::vector<NodeSet> nodeSets; ///< in the same order, null displacement before named; one per interface, not per side
  std::vector<Material> materials;
  std::vector<Section> sections; ///< every element belongs to exactly one
  std::vector<Shell> shells;     ///< no face belongs to two
  std::vector<Beam> beams;       ///< by curve and radius
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

enum class NodeShape
{
  Box,
  TurnedBox,
  Sphere,
  HalfSpace,
  NearestNode
};

/// A set of the nodes in some place, lengths in mm.
struct NodeChoice
{
  std::string name;
  NodeShape shape = NodeShape::Box;
  Vec3 a, b; ///< corners of a box; centre of a turned box or a sphere; a point of a half-space's plane and its normal,
             ///< inwards; the point whose nearest node it is
  double radius = 0;          ///< of a sphere
  std::array<Vec3, 3> axes{}; ///< of a turned box, of unit length
  Vec3 size;                  ///< of a turned box along them
};

/// What curves are made of.
struct BeamOptions
{
  bool areTrusses = false;
  TissueMaterial material; ///< linear elastic
};

struct FiniteElementOptions
{
  std::map<Label, TissueMaterial> materials; ///< tissues not listed share the material `default_material`
  std::vector<ShellChoice> shells;           ///< a face that several ask for belongs to the first
  std::vector<NodeChoice> nodes;             ///< sets of kind Named; those of one name are joined
  BeamOptions beams;                         ///< of the curves that the mesh has
};

/// Elements of any shape, and what travels with them in their file.
struct SolidMesh
{
  std::vector<Vec3> points;
  std::vector<Cell> elements;                                             ///< of positive volume
  std::vector<Label> labels;                                              ///< per element; not 0
  TissueTable tissues;                                                    ///< names and colours
  std::map<std::string, std::vector<std::int32_t>> elementSets, nodeSets; ///< ids by name, ascending
};

/// Sets, sections and shells of a mesh without label 0, as requireSound() wants it. An empty `subMesh` or
/// `constitutive` stands for zeros. A set of nodes by place becomes a surface, too, as below. Throws InputError for a shell of
/// a tissue that isn't there, or without a single face, and for a set of nodes without a node.
FiniteElementModel finiteElementModel(const MeshFile& content, const FiniteElementOptions& options = {});

/// The same with the mesh's own sets, kind Named. A set of nodes becomes a surface, too: the faces of the outer boundary
/// that have all their nodes in it, if there are any. Throws InputError, too, for a face that three elements share.
FiniteElementModel finiteElementModel(const SolidMesh& mesh, const FiniteElementOptions& options = {});

/// The sets by name as JSON: what a sidecar file holds. Format in Docs/FuchsTetrahedralizer.md.
std::string setNamesJSON(const FiniteElementModel& model);

} // namespace surgicalmesher
