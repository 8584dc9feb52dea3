// SPDX-License-Identifier: Apache-2.0
#include "GmshExport.h"

#include "ExportText.h"
#include "SetTags.h"

#include <algorithm>

namespace surgicalmesher
{
namespace
{

// Gmsh's element types.
constexpr int kTriangle = 2, kTetrahedron = 4, kPoint = 15;

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

/// Entities are the pieces, numbered from 1 in their order, and one point for all null-displacement nodes.
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
    for (const FaceSet& set : m_Tags.faceSets) names.push_back({ 2, set.tag, set.info->name });
    for (std::size_t s = 0; s < m_Tags.elementSets.size(); ++s)
    {
      names.push_back({ 3, m_Tags.elementSets[s], m_Model.elementSets[s].name });
    }
    return names;
  }

  template <class Cells>
  void writeBounds(const Cells& cells)
  {
    Vec3 low = m_Points[cells[0][0]], high = low;
    for (const auto& cell : cells)
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
    m_Out << " 0\n"; // entities that bound this one: not said
  }

  void writeEntities()
  {
    const auto& mesh = m_Model.content.mesh;
    m_Out << "$Entities\n"
          << !m_Fixed.empty() << " 0 " << m_Tags.facePieces.size() << ' ' << m_Tags.tetrahedronPieces.size() << '\n';
    if (!m_Fixed.empty()) m_Out << "1 " << m_Points[m_Fixed[0]] << " 1 " << m_Tags.nullDisplacement << '\n';
    for (std::size_t p = 0; p < m_Tags.facePieces.size(); ++p)
    {
      m_Out << p + 1 << ' ';
      writeBounds(m_Tags.facePieces[p].triangles);
      Ids tags;
      for (const std::size_t s : m_Tags.facePieces[p].sets) tags.push_back(m_Tags.faceSets[s].tag);
      writeTags(tags);
    }
    for (std::size_t p = 0; p < m_Tags.tetrahedronPieces.size(); ++p)
    {
      m_Out << p + 1 << ' ';
      std::vector<std::array<std::int32_t, 4>> cells;
      for (const std::int32_t t : m_Tags.tetrahedronPieces[p].tetrahedra) cells.push_back(mesh.tetrahedra[t]);
      writeBounds(cells);
      Ids tags;
      for (const std::size_t s : m_Tags.tetrahedronPieces[p].sets) tags.push_back(m_Tags.elementSets[s]);
      writeTags(tags);
    }
    m_Out << "$EndEntities\n";
  }

  /// The first surface that a point lies on, or else the first volume: index of the piece, volumes after all surfaces.
  Ids owners() const
  {
    Ids owner(m_Points.size(), -1);
    std::int32_t piece = 0;
    const auto claim = [&](std::int32_t id) { owner[id] = owner[id] < 0 ? piece : owner[id]; };
    for (const FacePiece& faces : m_Tags.facePieces)
    {
      for (const auto& triangle : faces.triangles) std::for_each(triangle.begin(), triangle.end(), claim);
      ++piece;
    }
    for (const TetrahedronPiece& cells : m_Tags.tetrahedronPieces)
    {
      for (const std::int32_t t : cells.tetrahedra)
      {
        const auto& corners = m_Model.content.mesh.tetrahedra[t];
        std::for_each(corners.begin(), corners.end(), claim);
      }
      ++piece;
    }
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

  void writeElements()
  {
    const auto& tetrahedra = m_Model.content.mesh.tetrahedra;
    std::size_t next = tetrahedra.size(), total = next + m_Fixed.size();
    for (const FacePiece& piece : m_Tags.facePieces) total += piece.triangles.size();
    m_Out << "$Elements\n"
          << !m_Fixed.empty() + m_Tags.facePieces.size() + m_Tags.tetrahedronPieces.size() << ' ' << total << " 1 "
          << total << '\n';
    if (!m_Fixed.empty()) m_Out << "0 1 " << kPoint << ' ' << m_Fixed.size() << '\n';
    for (const std::int32_t id : m_Fixed) m_Out << ++next << ' ' << id + 1 << '\n';
    for (std::size_t p = 0; p < m_Tags.facePieces.size(); ++p)
    {
      m_Out << "2 " << p + 1 << ' ' << kTriangle << ' ' << m_Tags.facePieces[p].triangles.size() << '\n';
      for (const auto& triangle : m_Tags.facePieces[p].triangles) m_Out << ++next << FromOne{ triangle } << '\n';
    }
    for (std::size_t p = 0; p < m_Tags.tetrahedronPieces.size(); ++p)
    {
      const Ids& members = m_Tags.tetrahedronPieces[p].tetrahedra;
      m_Out << "3 " << p + 1 << ' ' << kTetrahedron << ' ' << members.size() << '\n';
      for (const std::int32_t t : members) m_Out << t + 1 << FromOne{ tetrahedra[t] } << '\n';
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
  std::size_t next = mesh.tetrahedra.size(), total = next;
  for (const FacePiece& piece : tags.facePieces)
  {
    names.push_back({ 2, piece.tag, piece.name });
    total += piece.triangles.size();
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
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    out << t + 1 << ' ' << kTetrahedron << " 2 " << mesh.labels[t] << ' ' << mesh.labels[t]
        << FromOne{ mesh.tetrahedra[t] } << '\n';
  }
  for (const FacePiece& piece : tags.facePieces)
  {
    for (const auto& triangle : piece.triangles)
    {
      out << ++next << ' ' << kTriangle << " 2 " << piece.tag << ' ' << piece.tag << FromOne{ triangle } << '\n';
    }
  }
  out << "$EndElements\n";
  return out.str();
}

} // namespace

void writeGmsh41(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  writeBytes(Gmsh41(model).text(), destination(file));
}

void writeGmsh22(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  writeBytes(gmsh22(model), destination(file));
}

} // namespace surgicalmesher
