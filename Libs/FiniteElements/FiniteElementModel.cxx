// SPDX-License-Identifier: Apache-2.0
#include "FiniteElementModel.h"

#include "ConstitutiveTags.h"
#include "Errors.h"
#include "NodeChoices.h"
#include "SetNames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

namespace surgicalmesher
{
namespace
{

constexpr std::size_t kHalfName = 34; ///< for each of two names joined into one

using Ids = std::vector<std::int32_t>;

/// The neighbouring face of each face of each element; its element is -1 at the boundary of the mesh.
using Neighbours = std::vector<std::array<ElementFace, 6>>;

Neighbours neighboursOf(const std::vector<Cell>& elements)
{
  std::vector<std::pair<Cell, ElementFace>> faces;
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    for (int f = 0; f < faceCount(elements[e]); ++f)
      faces.push_back({ sorted(faceOf(elements[e], f)), { static_cast<std::int32_t>(e), f } });
  }
  std::stable_sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Neighbours result(elements.size());
  for (auto& across : result) across.fill({ -1, -1 });
  for (std::size_t i = 1; i < faces.size(); ++i)
  {
    if (!(faces[i].first == faces[i - 1].first)) continue;
    const ElementFace here = faces[i].second, there = faces[i - 1].second;
    if (result[there.element][there.face].element >= 0)
      throw InputError("element " + std::to_string(here.element) + " (the first is 0) has a face that three share");
    result[here.element][here.face] = there;
    result[there.element][there.face] = here;
  }
  return result;
}

/// The two sides of an interface: faces of elements of the group with the higher id, and of the other group.
struct Interface
{
  std::vector<ElementFace> high, low; ///< `low` is empty at the boundary of the mesh
};

/// Interfaces between groups of elements by [higher, lower] group; the space beyond the mesh counts as a group of its
/// own.
using Interfaces = std::map<std::array<std::int32_t, 2>, Interface>;

template <class Group>
Interfaces interfacesOf(const std::vector<Cell>& elements, const Neighbours& neighbours,
                        const std::vector<Group>& group, std::int32_t outside)
{
  Interfaces result;
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(group.size()); ++e)
  {
    for (std::int32_t f = 0; f < faceCount(elements[e]); ++f)
    {
      const ElementFace beyond = neighbours[e][f];
      const std::int32_t here = group[e], there = beyond.element < 0 ? outside : group[beyond.element];
      if (here <= there) continue;
      Interface& interface = result[{ here, there }];
      interface.high.push_back({ e, f });
      if (beyond.element >= 0) interface.low.push_back(beyond);
    }
  }
  return result;
}

template <class Group>
std::map<std::int32_t, Ids> membersOf(const std::vector<Group>& group)
{
  std::map<std::int32_t, Ids> result;
  for (std::size_t t = 0; t < group.size(); ++t) result[group[t]].push_back(static_cast<std::int32_t>(t));
  return result;
}

const char* nameOfLaw(MaterialLaw law) { return law == MaterialLaw::NeoHookean ? "neo_hookean" : "linear_elastic"; }

std::string tissueTitle(std::int32_t label, const TissueTable& tissues)
{
  if (label == 0) return "outside";
  const auto found = tissues.find(static_cast<Label>(label));
  const bool named = found != tissues.end() && !found->second.name.empty();
  return named ? found->second.name : "tissue " + std::to_string(label);
}

std::string subMeshTitle(std::int32_t id) { return id == 0 ? "parent" : "child " + std::to_string(id); }

std::string classTitle(std::int32_t id)
{
  return id == kNullDisplacement ? "null displacement" : id == kNonlinear ? "nonlinear" : "linear";
}

class Builder
{
public:
  Builder(const MeshFile& content, std::vector<Cell> elements, const FiniteElementOptions& options)
    : m_Options(options), m_Elements(m_Model.elements), m_Labels(m_Model.content.mesh.labels),
      m_Tissues(m_Model.content.tissues)
  {
    m_Model.content = content;
    m_Model.elements = std::move(elements);
    m_Model.content.subMesh.resize(m_Elements.size(), 0);
    m_Model.content.constitutive.resize(m_Elements.size(), 0);
    m_Neighbours = neighboursOf(m_Elements);
    reserveNames();
  }

  using NamedIds = std::map<std::string, std::vector<std::int32_t>>;

  FiniteElementModel build(const NamedIds& namedElements = {}, const NamedIds& namedNodes = {})
  {
    addElementSets();
    for (const auto& [name, members] : namedElements)
      m_Model.elementSets.push_back({ info(m_Names.unique(name), name, SetKind::Named, {}), members });
    addOuterBoundary();
    addTissueInterfaces();
    addSubMeshInterfaces();
    addNullDisplacement();
    for (const auto& [name, members] : namedNodes) addNamedNodes(name, members);
    addSections();
    for (const ShellChoice& choice : m_Options.shells) addShell(choice);
    for (std::size_t n = 0; n < m_Model.content.curves.size(); ++n) addBeams(n);
    return std::move(m_Model);
  }

private:
  /// Reserves the names that have the same meaning in every file first, so that no tissue takes them.
  void reserveNames()
  {
    for (const char* name : { "all_nodes", "all_elements", "outer_boundary", "outer_boundary_nodes",
                              "null_displacement_nodes", "submesh_interface_nodes", "outside" })
    {
      m_Names.unique(name);
    }
    for (const auto& [id, members] : membersOf(m_Model.content.subMesh))
    {
      m_SubMeshName[id] = m_Names.unique("submesh " + subMeshTitle(id));
    }
    for (const auto& [id, members] : membersOf(m_Model.content.constitutive))
    {
      m_ClassName[id] = m_Names.unique("constitutive " + classTitle(id));
    }
    m_TissueName[0] = "outside";
    for (const auto& [label, members] : membersOf(m_Labels))
    {
      m_TissueName[label] = m_Names.unique(tissueTitle(label, m_Tissues), "tissue_" + std::to_string(label));
    }
  }

  SetInfo info(std::string name, std::string original, SetKind kind, Ids ids) const
  {
    SetInfo result{ std::move(name), std::move(original), kind, std::move(ids), {} };
    const bool ofTissue = kind == SetKind::Tissue || kind == SetKind::TissueMaterial ||
                          kind == SetKind::TissueInterface || kind == SetKind::Shell;
    const auto tissue = ofTissue ? m_Tissues.find(static_cast<Label>(result.ids[0])) : m_Tissues.end();
    result.color = tissue == m_Tissues.end() ? Tissue().color : tissue->second.color;
    return result;
  }

  void addElementSets()
  {
    const auto add = [&](SetInfo info, const Ids& members) {
      m_Model.elementSets.push_back({ std::move(info), members });
    };
    for (const auto& [label, members] : membersOf(m_Labels))
    {
      add(info(m_TissueName[label], tissueTitle(label, m_Tissues), SetKind::Tissue, { label }), members);
    }
    for (const auto& [id, members] : membersOf(m_Model.content.subMesh))
    {
      add(info(m_SubMeshName[id], subMeshTitle(id), SetKind::SubMesh, { id }), members);
    }
    for (const auto& [id, members] : membersOf(m_Model.content.constitutive))
    {
      add(info(m_ClassName[id], classTitle(id), SetKind::Constitutive, { id }), members);
    }
  }

  /// Adds a surface. If `like` is given, its faces are used with opposite orientation, so that both sides list them in
  /// the same order.
  void addSurface(SetInfo info, const std::vector<ElementFace>& faces, const std::string& nodeSet,
                  const SurfaceSet* like = nullptr)
  {
    SurfaceSet surface;
    static_cast<SetInfo&>(surface) = std::move(info);
    surface.faces = faces;
    surface.nodeSet = nodeSet;
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      if (!like) surface.cells.push_back(faceOf(m_Elements[faces[i].element], faces[i].face));
      else surface.cells.push_back(turnedRound(like->cells[i]));
    }
    m_Model.surfaces.push_back(std::move(surface));
  }

  void addNodeSet(SetInfo info, Ids points)
  {
    if (!points.empty()) m_Model.nodeSets.push_back({ std::move(info), std::move(points) });
  }

  void addOuterBoundary()
  {
    const auto whole = interfacesOf(m_Elements, m_Neighbours, Ids(m_Elements.size(), 1), 0);
    if (whole.empty()) return;
    addSurface(info("outer_boundary", "outer boundary", SetKind::OuterBoundary, {}), whole.begin()->second.high,
               "outer_boundary_nodes");
    addNodeSet(info("outer_boundary_nodes", "outer boundary", SetKind::OuterBoundary, {}),
               nodesOf(m_Model.surfaces.back().cells));
  }

  /// Adds two surfaces and the set of their common nodes.
  void addInterface(const std::array<std::int32_t, 2>& ids, const Interface& interface, SetKind kind,
                    std::map<std::int32_t, std::string>& names, const std::string& original)
  {
    const std::string high = validName(names[ids[0]], kHalfName), low = validName(names[ids[1]], kHalfName);
    const std::string nodes = m_Names.unique(high + "_and_" + low);
    addSurface(info(m_Names.unique(high + "_to_" + low), original, kind, { ids[0], ids[1] }), interface.high, nodes);
    addNodeSet(info(nodes, original, kind, { ids[0], ids[1] }), nodesOf(m_Model.surfaces.back().cells));
    if (interface.low.empty()) return;
    const SurfaceSet side = m_Model.surfaces.back();
    addSurface(info(m_Names.unique(low + "_to_" + high), original, kind, { ids[1], ids[0] }), interface.low, nodes,
               &side);
  }

  void addTissueInterfaces()
  {
    for (const auto& [ids, interface] : interfacesOf(m_Elements, m_Neighbours, m_Labels, 0))
    {
      addInterface(ids, interface, SetKind::TissueInterface, m_TissueName,
                   tissueTitle(ids[0], m_Tissues) + " | " + tissueTitle(ids[1], m_Tissues));
    }
  }

  void addSubMeshInterfaces()
  {
    for (const auto& [ids, interface] : interfacesOf(m_Elements, m_Neighbours, m_Model.content.subMesh, -1))
    {
      if (ids[1] < 0) continue;
      addInterface(ids, interface, SetKind::SubMeshInterface, m_SubMeshName,
                   subMeshTitle(ids[0]) + " | " + subMeshTitle(ids[1]));
    }
    addNodeSet(info("submesh_interface_nodes", "all sub-mesh interfaces", SetKind::SubMeshInterface, {}),
               nodesOfSeveral(m_Elements, m_Model.content.mesh.points.size(), m_Model.content.subMesh));
  }

  void addNullDisplacement()
  {
    std::vector<Cell> still;
    for (std::size_t e = 0; e < m_Elements.size(); ++e)
    {
      if (m_Model.content.constitutive[e] == kNullDisplacement) still.push_back(m_Elements[e]);
    }
    addNodeSet(info("null_displacement_nodes", "null displacement", SetKind::NullDisplacement, {}), nodesOf(still));
  }

  void addNamedNodes(const std::string& name, const Ids& points)
  {
    const std::string nodes = m_Names.unique(name);
    std::vector<char> within(m_Model.content.mesh.points.size(), 0);
    for (const std::int32_t id : points) within[id] = 1;
    std::vector<ElementFace> faces;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(m_Elements.size()); ++e)
    {
      for (int f = 0; f < faceCount(m_Elements[e]); ++f)
      {
        const Cell face = faceOf(m_Elements[e], f);
        const bool all = std::all_of(face.begin(), face.end(), [&](std::int32_t id) { return within[id] != 0; });
        if (all && m_Neighbours[e][f].element < 0) faces.push_back({ e, f });
      }
    }
    if (!faces.empty()) addSurface(info(m_Names.unique(name + "_faces"), name, SetKind::Named, {}), faces, nodes);
    addNodeSet(info(nodes, name, SetKind::Named, {}), points);
  }

  /// Returns the index of the material of a tissue under `law`, creating it on first use.
  std::int32_t materialOf(std::int32_t label, MaterialLaw law)
  {
    const auto row = m_Options.materials.find(static_cast<Label>(label));
    const bool listed = row != m_Options.materials.end();
    const auto [entry, isNew] = m_MaterialIndex.emplace(std::make_pair(listed ? label : -1, law),
                                                        static_cast<std::int32_t>(m_Model.materials.size()));
    if (!isNew) return entry->second;
    const TissueMaterial properties = listed ? row->second : TissueMaterial();
    const std::string title = listed ? "material_" + validName(m_TissueName[label], kHalfName) : "default_material";
    m_Model.materials.push_back({ m_Names.unique(title + "_" + nameOfLaw(law)), law, properties.youngsModulus,
                                  properties.poissonsRatio, properties.density });
    return entry->second;
  }

  MaterialLaw lawOf(std::int32_t element) const
  {
    if (m_Model.content.constitutive[element] != kNonlinear) return MaterialLaw::LinearElastic;
    const auto row = m_Options.materials.find(m_Labels[element]);
    return row == m_Options.materials.end() ? TissueMaterial().nonlinearLaw : row->second.nonlinearLaw;
  }

  void addSections()
  {
    const std::map<std::int32_t, Ids> tissues = membersOf(m_Labels);
    std::int32_t tissueSet = 0;
    for (const auto& [label, members] : tissues)
    {
      std::map<MaterialLaw, Ids> byLaw;
      for (const std::int32_t e : members) byLaw[lawOf(e)].push_back(e);
      for (const auto& [law, some] : byLaw)
      {
        const std::int32_t set = byLaw.size() == 1 ? tissueSet : addTissueMaterialSet(label, law, some);
        m_Model.sections.push_back({ set, materialOf(label, law) });
      }
      ++tissueSet;
    }
  }

  std::int32_t addTissueMaterialSet(std::int32_t label, MaterialLaw law, const Ids& members)
  {
    const std::int32_t id = law == MaterialLaw::NeoHookean ? kNonlinear : 0;
    const std::string name = m_Names.unique(validName(m_TissueName[label], kHalfName) + "_" + classTitle(id));
    m_Model.elementSets.push_back(
      { info(name, tissueTitle(label, m_Tissues) + ", " + classTitle(id), SetKind::TissueMaterial, { label, id }),
        members });
    return static_cast<std::int32_t>(m_Model.elementSets.size() - 1);
  }

  Shell emptyShell(const ShellChoice& choice)
  {
    const bool one = choice.neighbour >= 0;
    const std::string half = validName(m_TissueName[choice.label], kHalfName);
    Ids ids{ choice.label };
    if (one) ids.push_back(choice.neighbour);
    Shell shell;
    static_cast<SetInfo&>(shell) =
      info(m_Names.unique(half + (one ? "_to_" + validName(m_TissueName[choice.neighbour], kHalfName) : "") + "_shell"),
           tissueTitle(choice.label, m_Tissues) + (one ? " | " + tissueTitle(choice.neighbour, m_Tissues) : ""),
           SetKind::Shell, ids);
    shell.thickness = choice.thickness;
    shell.material = materialOf(choice.label, MaterialLaw::LinearElastic);
    return shell;
  }

  void addShell(const ShellChoice& choice)
  {
    Shell shell = emptyShell(choice);
    for (std::size_t e = 0; e < m_Elements.size(); ++e)
    {
      for (int f = 0; m_Labels[e] == choice.label && f < faceCount(m_Elements[e]); ++f)
      {
        const std::int32_t beyond = m_Neighbours[e][f].element, there = beyond < 0 ? 0 : m_Labels[beyond];
        if (there == choice.label || (choice.neighbour >= 0 && there != choice.neighbour)) continue;
        const Cell face = faceOf(m_Elements[e], f);
        if (m_ShellFaces.insert(sorted(face)).second) shell.cells.push_back(face);
      }
    }
    if (shell.cells.empty())
    {
      throw InputError("shell of " + shell.original + ": no face of the mesh is left for it, at least one expected");
    }
    m_Model.shells.push_back(std::move(shell));
  }

  std::int32_t beamMaterial()
  {
    if (m_BeamMaterial >= 0) return m_BeamMaterial;
    const TissueMaterial& properties = m_Options.beams.material;
    m_Model.materials.push_back({ m_Names.unique("curve_material_linear_elastic"), MaterialLaw::LinearElastic,
                                  properties.youngsModulus, properties.poissonsRatio, properties.density });
    return m_BeamMaterial = static_cast<std::int32_t>(m_Model.materials.size() - 1);
  }

  /// Divides the edges of a curve by radius, since the section of a beam is constant: edges with radii within about 5 %
  /// share one section, whose area is the mean of theirs.
  void addBeams(std::size_t number)
  {
    const CurveChain& curve = m_Model.content.curves[number];
    const double step = std::log(1.1);
    std::map<long, Beam> sections;
    for (std::size_t k = 1; k < curve.points.size(); ++k)
    {
      const double radius = 0.5 * (curve.radii[k - 1] + curve.radii[k]);
      Beam& beam = sections[std::lround(std::log(radius) / step)];
      beam.edges.push_back({ curve.points[k - 1], curve.points[k] });
      beam.radius += radius * radius;
    }
    std::int32_t section = 0;
    for (auto& [classOfRadius, beam] : sections)
    {
      const std::string suffix = sections.size() > 1 ? "_section_" + std::to_string(++section) : "";
      static_cast<SetInfo&>(beam) = info(m_Names.unique(validName(curve.name, kHalfName) + suffix, "curve"), curve.name,
                                         SetKind::Beam, { std::int32_t(number) + 1, std::max(section, 1) });
      beam.radius = std::sqrt(beam.radius / double(beam.edges.size()));
      beam.isTruss = m_Options.beams.areTrusses;
      beam.material = beamMaterial();
      m_Model.beams.push_back(std::move(beam));
    }
  }

  const FiniteElementOptions& m_Options;
  FiniteElementModel m_Model;
  const std::vector<Cell>& m_Elements;
  const std::vector<Label>& m_Labels;
  const TissueTable& m_Tissues;
  Neighbours m_Neighbours;
  SetNames m_Names;
  std::map<std::int32_t, std::string> m_TissueName, m_SubMeshName, m_ClassName;
  /// By label (-1 for the default material) and law.
  std::map<std::pair<std::int32_t, MaterialLaw>, std::int32_t> m_MaterialIndex;
  std::set<Cell> m_ShellFaces;
  std::int32_t m_BeamMaterial = -1;
};

} // namespace

double sectionArea(const Beam& beam) { return 3.14159265358979323846 * beam.radius * beam.radius; }

double secondMomentOfArea(const Beam& beam) { return sectionArea(beam) * beam.radius * beam.radius / 4; }

Vec3 axisAcross(const Cell& edge, const std::vector<Vec3>& points)
{
  const Vec3 along = points[edge[1]] - points[edge[0]];
  int least = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(along[axis]) < std::abs(along[least])) least = axis;
  Vec3 across{ 0, 0, 0 };
  across[least] = 1;
  return across;
}

std::string nameOf(SetKind kind)
{
  switch (kind)
  {
  case SetKind::Tissue: return "tissue";
  case SetKind::SubMesh: return "subMesh";
  case SetKind::Constitutive: return "constitutive";
  case SetKind::TissueMaterial: return "tissueMaterial";
  case SetKind::OuterBoundary: return "outerBoundary";
  case SetKind::TissueInterface: return "tissueInterface";
  case SetKind::SubMeshInterface: return "subMeshInterface";
  case SetKind::NullDisplacement: return "nullDisplacement";
  case SetKind::Shell: return "shell";
  case SetKind::Named: return "named";
  case SetKind::Beam: return "beam";
  }
  return {};
}

FiniteElementModel finiteElementModel(const MeshFile& content, const FiniteElementOptions& options)
{
  const auto& tetrahedra = content.mesh.tetrahedra;
  return Builder(content, { tetrahedra.begin(), tetrahedra.end() }, options)
    .build({}, chosenNodes(options.nodes, content.mesh.points));
}

FiniteElementModel finiteElementModel(const SolidMesh& mesh, const FiniteElementOptions& options)
{
  MeshFile content;
  content.mesh.points = mesh.points;
  content.mesh.labels = mesh.labels;
  content.tissues = mesh.tissues;
  std::map<std::string, std::vector<std::int32_t>> nodeSets = mesh.nodeSets;
  for (auto& [name, nodes] : chosenNodes(options.nodes, mesh.points))
  {
    if (!nodeSets.insert({ name, std::move(nodes) }).second)
      throw InputError(name + ": the mesh has a set of nodes of this name, expected another name for the chosen nodes");
  }
  return Builder(content, mesh.elements, options).build(mesh.elementSets, nodeSets);
}

} // namespace surgicalmesher
