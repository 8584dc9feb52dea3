// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A mesh as solvers see it: named sets of elements, nodes and faces, materials, shells and beams. All exports are
/// written from this model alone.
///
/// Ids of points and elements count from 0, as in the mesh; formats that count from 1 add 1. Lengths in mm, frame LPS.
/// Materials have consistent units: N, tonne, s, hence MPa and tonne/mm^3. Units.h converts to SI units.

#include "Cell.h"
#include "MeshIO.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// What a set stands for, and in brackets the meaning of its SetInfo::ids.
enum class SetKind
{
  Tissue,           ///< elements; [label]
  SubMesh,          ///< elements; [0 parent, 1..n child]
  Constitutive,     ///< elements; [0 linear, 1 nonlinear, 2 null displacement]
  TissueMaterial,   ///< elements of a tissue with one of its materials, if it has two; [label, constitutive class]
  OuterBoundary,    ///< faces and nodes of the boundary of the whole mesh; []
  TissueInterface,  ///< faces: [label behind, label in front]; nodes: [higher label, lower label]; 0 is outside
  SubMeshInterface, ///< likewise between sub-meshes; nodes where any sub-meshes meet: []
  NullDisplacement, ///< nodes of null-displacement elements; []
  Shell,            ///< faces; [label] or [label, neighbour]
  Beam,             ///< edges; [curve, section], both from 1
  Named             ///< elements, nodes or faces by a name given with the mesh or by the user; []
};

/// Returns the name of a kind in sidecars: "tissue", "subMesh", "constitutive", "tissueMaterial", "outerBoundary",
/// "tissueInterface", "subMeshInterface", "nullDisplacement", "shell", "beam", "named".
std::string nameOf(SetKind kind);

/// Members that all sets have in common.
struct SetInfo
{
  std::string name;     ///< in files; unique among all sets and materials, see SetNames.h
  std::string original; ///< for display: the tissue's own name, or the two of an interface joined by " | "
  SetKind kind{};
  std::vector<std::int32_t> ids;                ///< see SetKind
  std::array<double, 3> color{ 0.8, 0.8, 0.8 }; ///< RGB in [0, 1], of the (first) tissue
};

struct ElementSet : SetInfo
{
  std::vector<std::int32_t> elements; ///< ascending
};

struct NodeSet : SetInfo
{
  std::vector<std::int32_t> points; ///< ascending
};

/// An oriented surface. An interface between a and b consists of two such sets, one of faces of a's elements and one of
/// b's, with the same faces in the same order and opposite orientation; the set with the higher id behind comes first.
struct SurfaceSet : SetInfo
{
  std::vector<ElementFace> faces;
  std::vector<Cell> cells; ///< the same faces as point ids, normals pointing out of their elements
  std::string nodeSet;     ///< name of the set of its points
};

/// Law of a material.
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

/// A set of elements and their material.
struct Section
{
  std::int32_t elementSet; ///< index into FiniteElementModel::elementSets
  std::int32_t material;   ///< index into FiniteElementModel::materials
};

/// Faces of the mesh as shell elements, oriented out of the tissue.
struct Shell : SetInfo
{
  std::vector<Cell> cells;   ///< point ids of the mesh
  double thickness = 0;      ///< mm
  std::int32_t material = 0; ///< index into FiniteElementModel::materials
};

/// Edges of the mesh along a curve, as beams or trusses with one round section.
struct Beam : SetInfo
{
  std::vector<Cell> edges;   ///< point ids of the mesh, along the curve
  double radius = 0;         ///< mm
  bool isTruss = false;      ///< axial stiffness only
  std::int32_t material = 0; ///< index into FiniteElementModel::materials
};

/// Area and second moment of area of the round section, in the square and the fourth power of the unit of the radius.
double sectionArea(const Beam& beam);
double secondMomentOfArea(const Beam& beam);

/// Returns the coordinate axis most perpendicular to an edge: the orientation of its section for solvers that require
/// one.
Vec3 axisAcross(const Cell& edge, const std::vector<Vec3>& points);

/// Units of all numbers of a model.
enum class Units
{
  Millimetres, ///< mm, N, MPa, tonne, s
  SI           ///< m, N, Pa, kg, s
};

struct FiniteElementModel
{
  Units units = Units::Millimetres;
  /// Points, labels and the arrays that belong to them; subMesh and constitutive are filled. Without elements if the
  /// model is made from a SolidMesh.
  MeshFile content;
  std::vector<Cell> elements;          ///< of any shape
  std::vector<ElementSet> elementSets; ///< by kind: tissues, sub-meshes, constitutive classes, named, tissue materials
  std::vector<SurfaceSet> surfaces;    ///< outer boundary, interfaces of tissues (and outside), of sub-meshes, named
  /// In the same order, null displacement before named; an interface has one node set, not one per side.
  std::vector<NodeSet> nodeSets;
  std::vector<Material> materials;
  std::vector<Section> sections; ///< every element belongs to exactly one
  std::vector<Shell> shells;     ///< no face belongs to two shells
  std::vector<Beam> beams;       ///< one per curve and class of radii
};

/// A tissue's row of a material table; the values here are the default for tissues without one.
struct TissueMaterial
{
  MaterialLaw nonlinearLaw = MaterialLaw::NeoHookean; ///< of tetrahedra tagged nonlinear; all others are linear elastic
  double youngsModulus = 0.003;                       ///< MPa; the default is that of soft tissue
  double poissonsRatio = 0.45;
  double density = 1e-9; ///< tonne/mm^3
};

/// A tissue whose boundary becomes a shell.
struct ShellChoice
{
  Label label = 0;
  /// The shell covers only the interface with this label (0: outside); -1: the whole boundary.
  std::int32_t neighbour = -1;
  double thickness = 1; ///< mm
};

enum class NodeShape
{
  Box,
  TurnedBox,
  Sphere,
  HalfSpace,
  NearestNode
};

/// A set of the nodes in a region, lengths in mm.
struct NodeChoice
{
  std::string name;
  NodeShape shape = NodeShape::Box;
  /// Corners of a box; centre of a turned box or a sphere (a); a point of a half-space's plane and its normal, which
  /// points inwards; the point whose nearest node is chosen (a).
  Vec3 a, b;
  double radius = 0;          ///< of a sphere
  std::array<Vec3, 3> axes{}; ///< of a turned box, unit vectors
  Vec3 size;                  ///< of a turned box along its axes
};

/// Properties of the curves of a mesh.
struct BeamOptions
{
  bool areTrusses = false;
  TissueMaterial material; ///< linear elastic
};

struct FiniteElementOptions
{
  std::map<Label, TissueMaterial> materials; ///< tissues not listed share the material `default_material`
  std::vector<ShellChoice> shells;           ///< a face claimed by several belongs to the first
  std::vector<NodeChoice> nodes;             ///< sets of kind Named; choices with the same name are joined
  BeamOptions beams;                         ///< for the curves of the mesh
};

/// Elements of any shape, and the data stored with them in their file.
struct SolidMesh
{
  std::vector<Vec3> points;
  std::vector<Cell> elements;                                             ///< of positive volume
  std::vector<Label> labels;                                              ///< per element; not 0
  TissueTable tissues;                                                    ///< names and colours
  std::map<std::string, std::vector<std::int32_t>> elementSets, nodeSets; ///< ids by name, ascending
};

/// Returns the model with sets, sections and shells of a mesh without label 0 that meets requireSound(). An empty
/// `subMesh` or `constitutive` stands for zeros. For node sets chosen by place, a surface is added as in the overload
/// below. Throws InputError for a shell of an absent tissue or without a face, and for a node set without a node.
FiniteElementModel finiteElementModel(const MeshFile& content, const FiniteElementOptions& options = {});

/// The same with the sets of the mesh, as kind Named. For each named node set, the outer-boundary faces with all their
/// nodes in it, if any, are added as a surface. Also throws InputError for a face shared by three elements, and for a
/// chosen node set with the name of a set of the mesh.
FiniteElementModel finiteElementModel(const SolidMesh& mesh, const FiniteElementOptions& options = {});

/// Returns the sets by name as JSON, the content of a sidecar file. The format is described in
/// Docs/FuchsTetrahedralizer.md.
std::string setNamesJSON(const FiniteElementModel& model);

} // namespace surgicalmesher
