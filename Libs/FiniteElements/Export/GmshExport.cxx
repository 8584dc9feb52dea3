// SPDX-License-Identifier: Apache-2.0
#include "GmshExport.h"

#include "Errors.h"
#include "ExportText.h"
#include "SetTags.h"
#include "TextFile.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace surgicalmesher
{
namespace
{

// Element types of Gmsh.
constexpr int kLine = 1, kPoint = 15;
int typeOf(const Cell& element)
{
  if (element.size() == 10) return 11;
  return element.size() == 4 ? 4 : element.size() == 6 ? 6 : 5;
}
int typeOfFace(const Cell& face) { return face.size() == 3 ? 2 : face.size() == 6 ? 9 : 3; }

/// In Gmsh, the midpoint of edge 23 precedes that of edge 13.
Cell inOrderOfGmsh(Cell element)
{
  if (element.size() == 10) std::swap(element.begin()[8], element.begin()[9]);
  return element;
}

struct PhysicalName
{
  int dimension;
  std::int32_t tag;
  std::string name;
};

void writeHeader(std::ostream& out, const char* version, const std::vector<PhysicalName>& names)
{
  out << "$MeshFormat\n" << version << " 0 8\n$EndMeshFormat\n$PhysicalNames\n" << names.size() << '\n';
  for (const PhysicalName& name : names) out << name.dimension << ' ' << name.tag << " \"" << name.name << "\"\n";
  out << "$EndPhysicalNames\n";
}

// ---- 4.1 ------------------------------------------------------------------------------------------------------------

/// Entities are beams and pieces, numbered from 1 in their order, and one point entity for all null-displacement nodes.
class Gmsh41
{
public:
  explicit Gmsh41(const FiniteElementModel& model)
    : m_Model(model), m_Points(model.content.mesh.points), m_Tags(tagsOf(model)), m_Fixed(m_Tags.fixedPoints)
  {
  }

  std::string text()
  {
    writeHeader(m_Out, "4.1", physicalNames());
    writeEntities();
    writeNodes();
    writeElements();
    return m_Out.str();
  }

private:
  using Ids = std::vector<std::int32_t>;

  std::vector<PhysicalName> physicalNames() const
  {
    std::vector<PhysicalName> names;
    if (!m_Fixed.empty()) names.push_back({ 0, m_Tags.nullDisplacement, "null_displacement_nodes" });
    for (std::size_t b = 0; b < m_Tags.beams.size(); ++b)
      names.push_back({ 1, m_Tags.beams[b], m_Model.beams[b].name });
    for (const FaceSet& set : m_Tags.faceSets) names.push_back({ 2, set.tag, set.info->name });
    for (std::size_t s = 0; s < m_Tags.elementSets.size(); ++s)
    {
      names.push_back({ 3, m_Tags.elementSets[s], m_Model.elementSets[s].name });
    }
    return names;
  }

  void writeBounds(const std::vector<Cell>& cells)
  {
    Vec3 low = m_Points[cells[0][0]], high = low;
    for (const Cell& cell : cells)
    {
      for (const std::int32_t id : cell)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::min(low[axis], m_Points[id][axis]);
          high[axis] = std::max(high[axis], m_Points[id][axis]);
        }
      }
    }
    m_Out << low << ' ' << high << ' ';
  }

  void writeTags(const std::vector<std::int32_t>& tags)
  {
    m_Out << tags.size();
    for (const std::int32_t tag : tags) m_Out << ' ' << tag;
    m_Out << " 0\n"; // bounding entities are not given
  }

  void writeEntities()
  {
    m_Out << "$Entities\n"
          << !m_Fixed.empty() << ' ' << m_Model.beams.size() << ' ' << m_Tags.facePieces.size() << ' '
          << m_Tags.elementPieces.size() << '\n';
    if (!m_Fixed.empty()) m_Out << "1 " << m_Points[m_Fixed[0]] << " 1 " << m_Tags.nullDisplacement << '\n';
    for (std::size_t b = 0; b < m_Model.beams.size(); ++b)
    {
      m_Out << b + 1 << ' ';
      writeBounds(m_Model.beams[b].edges);
      writeTags({ m_Tags.beams[b] });
    }
    for (std::size_t p = 0; p < m_Tags.facePieces.size(); ++p)
    {
      m_Out << p + 1 << ' ';
      writeBounds(m_Tags.facePieces[p].cells);
      Ids tags;
      for (const std::size_t s : m_Tags.facePieces[p].sets) tags.push_back(m_Tags.faceSets[s].tag);
      writeTags(tags);
    }
    for (std::size_t p = 0; p < m_Tags.elementPieces.size(); ++p)
    {
      m_Out << p + 1 << ' ';
      std::vector<Cell> cells;
      for (const std::int32_t e : m_Tags.elementPieces[p].elements) cells.push_back(m_Model.elements[e]);
      writeBounds(cells);
      Ids tags;
      for (const std::size_t s : m_Tags.elementPieces[p].sets) tags.push_back(m_Tags.elementSets[s]);
      writeTags(tags);
    }
    m_Out << "$EndEntities\n";
  }

  /// Returns for each point the piece that owns it: the first surface on which it lies, otherwise the first volume;
  /// volumes are indexed after all surfaces. The first volume owns the points that no element uses.
  Ids owners() const
  {
    Ids owner(m_Points.size(), -1);
    std::int32_t piece = 0;
    const auto claim = [&](std::int32_t id) { owner[id] = owner[id] < 0 ? piece : owner[id]; };
    for (const FacePiece& faces : m_Tags.facePieces)
    {
      for (const Cell& face : faces.cells) std::for_each(face.begin(), face.end(), claim);
      ++piece;
    }
    for (const ElementPiece& cells : m_Tags.elementPieces)
    {
      for (const std::int32_t e : cells.elements)
      {
        const Cell& corners = m_Model.elements[e];
        std::for_each(corners.begin(), corners.end(), claim);
      }
      ++piece;
    }
    std::replace(owner.begin(), owner.end(), -1, static_cast<std::int32_t>(m_Tags.facePieces.size()));
    return owner;
  }

  void writeNodes()
  {
    const std::size_t surfaces = m_Tags.facePieces.size();
    std::map<std::int32_t, Ids> pointsOf;
    const Ids owner = owners();
    for (std::size_t i = 0; i < owner.size(); ++i) pointsOf[owner[i]].push_back(static_cast<std::int32_t>(i));
    m_Out << "$Nodes\n" << pointsOf.size() << ' ' << m_Points.size() << " 1 " << m_Points.size() << '\n';
    for (const auto& [piece, ids] : pointsOf)
    {
      const std::size_t index = static_cast<std::size_t>(piece);
      const bool surface = index < surfaces;
      m_Out << (surface ? 2 : 3) << ' ' << (surface ? index : index - surfaces) + 1 << " 0 " << ids.size() << '\n';
      for (const std::int32_t id : ids) m_Out << id + 1 << '\n';
      for (const std::int32_t id : ids) m_Out << m_Points[id] << '\n';
    }
    m_Out << "$EndNodes\n";
  }

  /// Elements of one type in one entity, each with its number.
  struct Block
  {
    int dimension = 0, type = 0;
    std::size_t entity = 0;
    std::vector<std::pair<std::size_t, Cell>> rows;
  };

  /// Appends a block for each element type of an entity.
  static void addBlocks(std::vector<Block>& blocks, int dimension, std::size_t entity,
                        const std::vector<std::pair<std::size_t, Cell>>& rows)
  {
    std::map<int, Block> byType;
    for (const auto& row : rows)
    {
      const int type = dimension == 0   ? kPoint
                       : dimension == 1 ? kLine
                       : dimension == 2 ? typeOfFace(row.second)
                                        : typeOf(row.second);
      Block& block = byType.try_emplace(type, Block{ dimension, type, entity, {} }).first->second;
      block.rows.push_back(row);
    }
    for (auto& [type, block] : byType) blocks.push_back(std::move(block));
  }

  std::vector<Block> blocksOfAll() const
  {
    std::vector<Block> blocks;
    std::vector<std::pair<std::size_t, Cell>> rows;
    std::size_t next = m_Model.elements.size();
    for (const std::int32_t id : m_Fixed) rows.push_back({ ++next, { id } });
    addBlocks(blocks, 0, 1, rows);
    for (std::size_t b = 0; b < m_Model.beams.size(); ++b)
    {
      rows.clear();
      for (const Cell& edge : m_Model.beams[b].edges) rows.push_back({ ++next, edge });
      addBlocks(blocks, 1, b + 1, rows);
    }
    for (std::size_t p = 0; p < m_Tags.facePieces.size(); ++p)
    {
      rows.clear();
      for (const Cell& face : m_Tags.facePieces[p].cells) rows.push_back({ ++next, face });
      addBlocks(blocks, 2, p + 1, rows);
    }
    for (std::size_t p = 0; p < m_Tags.elementPieces.size(); ++p)
    {
      rows.clear();
      for (const std::int32_t e : m_Tags.elementPieces[p].elements)
        rows.push_back({ std::size_t(e) + 1, inOrderOfGmsh(m_Model.elements[e]) });
      addBlocks(blocks, 3, p + 1, rows);
    }
    return blocks;
  }

  void writeElements()
  {
    const std::vector<Block> blocks = blocksOfAll();
    std::size_t total = 0;
    for (const Block& block : blocks) total += block.rows.size();
    m_Out << "$Elements\n" << blocks.size() << ' ' << total << " 1 " << total << '\n';
    for (const Block& block : blocks)
    {
      m_Out << block.dimension << ' ' << block.entity << ' ' << block.type << ' ' << block.rows.size() << '\n';
      for (const auto& [number, cell] : block.rows) m_Out << number << FromOne{ cell } << '\n';
    }
    m_Out << "$EndElements\n";
  }

  const FiniteElementModel& m_Model;
  const std::vector<Vec3>& m_Points;
  const SetTags m_Tags;
  const Ids& m_Fixed;
  ExportText m_Out;
};

// ---- 2.2 ------------------------------------------------------------------------------------------------------------

std::string gmsh22(const FiniteElementModel& model)
{
  const TetMesh& mesh = model.content.mesh;
  const SetTags tags = tagsOf(model);
  std::vector<PhysicalName> names;
  std::size_t next = model.elements.size(), total = next;
  for (const FacePiece& piece : tags.facePieces)
  {
    names.push_back({ 2, piece.tag, piece.name });
    total += piece.cells.size();
  }
  for (std::size_t b = 0; b < model.beams.size(); ++b)
  {
    names.push_back({ 1, tags.beams[b], model.beams[b].name });
    total += model.beams[b].edges.size();
  }
  for (const ElementSet& set : model.elementSets)
  {
    if (set.kind == SetKind::Tissue) names.push_back({ 3, set.ids[0], set.name });
  }
  ExportText out;
  writeHeader(out, "2.2", names);
  out << "$Nodes\n" << mesh.points.size() << '\n';
  for (std::size_t i = 0; i < mesh.points.size(); ++i) out << i + 1 << ' ' << mesh.points[i] << '\n';
  out << "$EndNodes\n$Elements\n" << total << '\n';
  for (std::size_t e = 0; e < model.elements.size(); ++e)
  {
    const Cell& element = model.elements[e];
    out << e + 1 << ' ' << typeOf(element) << " 2 " << mesh.labels[e] << ' ' << mesh.labels[e]
        << FromOne{ inOrderOfGmsh(element) } << '\n';
  }
  for (const FacePiece& piece : tags.facePieces)
  {
    for (const Cell& face : piece.cells)
    {
      out << ++next << ' ' << typeOfFace(face) << " 2 " << piece.tag << ' ' << piece.tag << FromOne{ face } << '\n';
    }
  }
  for (std::size_t b = 0; b < model.beams.size(); ++b)
  {
    for (const Cell& edge : model.beams[b].edges)
      out << ++next << ' ' << kLine << " 2 " << tags.beams[b] << ' ' << tags.beams[b] << FromOne{ edge } << '\n';
  }
  out << "$EndElements\n";
  return out.str();
}

// ---- SimNIBS --------------------------------------------------------------------------------------------------------

constexpr std::int32_t kFirstElectrode = 100, kFacesOfTissue = 1000;

/// Returns the rank of a tissue: a face between two tissues belongs to the one of lower rank. Label 0 is outside.
std::int32_t rankInSimnibs(std::int32_t label)
{
  constexpr std::int32_t kRanked[] = { 1, 2, 9, 3, 4, 8, 7, 6, 10, 5 };
  const auto* found = std::find(std::begin(kRanked), std::end(kRanked), label);
  if (label == 0) return kFirstElectrode + kFacesOfTissue;
  return found != std::end(kRanked) ? static_cast<std::int32_t>(found - std::begin(kRanked)) : kFirstElectrode + label;
}

void requireSimnibs(const FiniteElementModel& model, const std::string& file)
{
  for (const Cell& element : model.elements)
    if (element.size() != 4) throw UsageError(file + ": SimNIBS knows tetrahedra of four nodes alone");
  for (const Label label : model.content.mesh.labels)
  {
    if (label >= kFirstElectrode)
      throw InputError(file + ": label " + std::to_string(label) + " found, SimNIBS's tissues are 1 to 99 and its " +
                       "electrodes the others");
  }
}

std::string simnibs(const FiniteElementModel& model)
{
  const TetMesh& mesh = model.content.mesh;
  std::vector<PhysicalName> names;
  for (const ElementSet& set : model.elementSets)
  {
    if (set.kind != SetKind::Tissue) continue;
    names.push_back({ 3, set.ids[0], set.name });
    names.push_back({ 2, set.ids[0] + kFacesOfTissue, set.name });
  }
  std::vector<std::pair<std::int32_t, Cell>> faces; // each with its tag
  for (const SurfaceSet& surface : model.surfaces)
  {
    if (surface.kind != SetKind::TissueInterface || rankInSimnibs(surface.ids[0]) > rankInSimnibs(surface.ids[1]))
      continue;
    for (const Cell& face : surface.cells) faces.push_back({ surface.ids[0] + kFacesOfTissue, face });
  }
  std::stable_sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ExportText out;
  writeHeader(out, "2.2", names);
  out << "$Nodes\n" << mesh.points.size() << '\n';
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3& p = mesh.points[i];
    out << i + 1 << ' ' << Vec3{ -p.x, -p.y, p.z } << '\n';
  }
  out << "$EndNodes\n$Elements\n" << faces.size() + model.elements.size() << '\n';
  std::size_t next = 0;
  for (const auto& [tag, face] : faces) out << ++next << " 2 2 " << tag << ' ' << tag << FromOne{ face } << '\n';
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    out << ++next << " 4 2 " << mesh.labels[e] << ' ' << mesh.labels[e] << FromOne{ model.elements[e] } << '\n';
  out << "$EndElements\n";
  return out.str();
}

} // namespace

void writeSimnibs(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  requireSimnibs(model, file);
  writeBytes(simnibs(model), destination(file));
}

void writeGmsh41(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  writeBytes(Gmsh41(model).text(), destination(file));
}

void writeGmsh22(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  writeBytes(gmsh22(model), destination(file));
}

} // namespace surgicalmesher
