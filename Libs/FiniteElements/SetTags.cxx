// SPDX-License-Identifier: Apache-2.0
#include "SetTags.h"

#include <algorithm>

namespace surgicalmesher
{
namespace
{

bool isSecondSide(const SurfaceSet& surface)
{
  const bool interface = surface.kind == SetKind::TissueInterface || surface.kind == SetKind::SubMeshInterface;
  return interface && surface.ids[0] < surface.ids[1];
}

class Numbering
{
public:
  explicit Numbering(const FiniteElementModel& model) : m_Model(model)
  {
    for (const Label label : model.content.mesh.labels) m_Last = std::max<std::int32_t>(m_Last, label);
  }

  SetTags number()
  {
    for (const ElementSet& set : m_Model.elementSets)
    {
      m_Tags.elementSets.push_back(set.kind == SetKind::Tissue ? set.ids[0] : ++m_Last);
    }
    m_Tags.surfaces.resize(m_Model.surfaces.size());
    for (const auto kind : { SetKind::TissueInterface, SetKind::SubMeshInterface, SetKind::OuterBoundary })
    {
      numberSurfaces(kind);
    }
    for (const Shell& shell : m_Model.shells)
    {
      m_Tags.shells.push_back(++m_Last);
      m_Tags.faceSets.push_back({ m_Last, &shell, &shell.triangles });
    }
    m_Tags.nullDisplacement = ++m_Last;
    for (const NodeSet& set : m_Model.nodeSets)
    {
      if (set.kind == SetKind::NullDisplacement) m_Tags.fixedPoints = set.points;
    }
    divideTetrahedra();
    divideFaces();
    return std::move(m_Tags);
  }

private:
  void numberSurfaces(SetKind kind)
  {
    for (std::size_t i = 0; i < m_Model.surfaces.size(); ++i)
    {
      const SurfaceSet& surface = m_Model.surfaces[i];
      if (surface.kind != kind) continue;
      if (!isSecondSide(surface)) m_Tags.faceSets.push_back({ ++m_Last, &surface, &surface.triangles });
      m_Tags.surfaces[i] = m_Last;
    }
  }

  void divideTetrahedra()
  {
    std::vector<std::vector<std::size_t>> setsOf(m_Model.content.mesh.tetrahedra.size());
    for (std::size_t s = 0; s < m_Model.elementSets.size(); ++s)
    {
      for (const std::int32_t t : m_Model.elementSets[s].tetrahedra) setsOf[t].push_back(s);
    }
    std::map<std::vector<std::size_t>, std::vector<std::int32_t>> pieces;
    for (std::size_t t = 0; t < setsOf.size(); ++t) pieces[setsOf[t]].push_back(static_cast<std::int32_t>(t));
    for (auto& [sets, tetrahedra] : pieces) m_Tags.tetrahedronPieces.push_back({ sets, std::move(tetrahedra) });
  }

  void divideFaces()
  {
    struct Face
    {
      std::array<std::int32_t, 3> triangle;
      std::vector<std::size_t> sets;
    };
    std::map<std::array<std::int32_t, 3>, Face> faces;
    for (std::size_t s = 0; s < m_Tags.faceSets.size(); ++s)
    {
      for (const auto& triangle : *m_Tags.faceSets[s].triangles)
      {
        std::array<std::int32_t, 3> corners = triangle;
        std::sort(corners.begin(), corners.end());
        faces.emplace(corners, Face{ triangle, {} }).first->second.sets.push_back(s);
      }
    }
    std::map<std::vector<std::size_t>, std::vector<std::array<std::int32_t, 3>>> pieces;
    for (const auto& [corners, face] : faces) pieces[face.sets].push_back(face.triangle);
    for (auto& [sets, triangles] : pieces) addPiece(sets, std::move(triangles));
  }

  void addPiece(const std::vector<std::size_t>& sets, std::vector<std::array<std::int32_t, 3>> triangles)
  {
    FacePiece piece{ 0, {}, sets, std::move(triangles) };
    for (const std::size_t s : sets)
    {
      const FaceSet& set = m_Tags.faceSets[s];
      if (set.info->kind == SetKind::OuterBoundary) continue; // always a tissue's interface as well
      piece.tag = piece.name.empty() ? set.tag : 0;
      piece.name += (piece.name.empty() ? "" : "__") + set.info->name;
    }
    if (piece.tag == 0) piece.tag = ++m_Last;
    m_Tags.facePieces.push_back(std::move(piece));
  }

  const FiniteElementModel& m_Model;
  std::int32_t m_Last = 0;
  SetTags m_Tags;
};

} // namespace

SetTags tagsOf(const FiniteElementModel& model) { return Numbering(model).number(); }

std::vector<std::int32_t> piecesOf(const SetTags& tags, std::int32_t faceSetTag)
{
  std::vector<std::int32_t> result;
  for (const FacePiece& piece : tags.facePieces)
  {
    const bool within = std::any_of(piece.sets.begin(), piece.sets.end(),
                                    [&](std::size_t s) { return tags.faceSets[s].tag == faceSetTag; });
    if (within) result.push_back(piece.tag);
  }
  std::sort(result.begin(), result.end());
  return result;
}

} // namespace surgicalmesher
