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
    for (const auto kind :
         { SetKind::TissueInterface, SetKind::SubMeshInterface, SetKind::OuterBoundary, SetKind::Named })
    {
      numberSurfaces(kind);
    }
    for (const Shell& shell : m_Model.shells)
    {
      m_Tags.shells.push_back(++m_Last);
      m_Tags.faceSets.push_back({ m_Last, &shell, &shell.cells });
    }
    m_Tags.nullDisplacement = ++m_Last;
    for (std::size_t i = 0; i < m_Model.beams.size(); ++i) m_Tags.beams.push_back(++m_Last);
    for (const NodeSet& set : m_Model.nodeSets)
    {
      if (set.kind == SetKind::NullDisplacement) m_Tags.fixedPoints = set.points;
    }
    divideElements();
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
      if (!isSecondSide(surface)) m_Tags.faceSets.push_back({ ++m_Last, &surface, &surface.cells });
      m_Tags.surfaces[i] = m_Last;
    }
  }

  void divideElements()
  {
    std::vector<std::vector<std::size_t>> setsOf(m_Model.elements.size());
    for (std::size_t s = 0; s < m_Model.elementSets.size(); ++s)
    {
      for (const std::int32_t e : m_Model.elementSets[s].elements) setsOf[e].push_back(s);
    }
    std::map<std::vector<std::size_t>, std::vector<std::int32_t>> pieces;
    for (std::size_t e = 0; e < setsOf.size(); ++e) pieces[setsOf[e]].push_back(static_cast<std::int32_t>(e));
    for (auto& [sets, elements] : pieces) m_Tags.elementPieces.push_back({ sets, std::move(elements) });
  }

  void divideFaces()
  {
    struct Face
    {
      Cell cell;
      std::vector<std::size_t> sets;
    };
    std::map<Cell, Face> faces;
    for (std::size_t s = 0; s < m_Tags.faceSets.size(); ++s)
    {
      for (const Cell& cell : *m_Tags.faceSets[s].cells)
        faces.emplace(sorted(cell), Face{ cell, {} }).first->second.sets.push_back(s);
    }
    std::map<std::vector<std::size_t>, std::vector<Cell>> pieces;
    for (const auto& [corners, face] : faces) pieces[face.sets].push_back(face.cell);
    for (auto& [sets, cells] : pieces) addPiece(sets, std::move(cells));
  }

  void addPiece(const std::vector<std::size_t>& sets, std::vector<Cell> cells)
  {
    FacePiece piece{ 0, {}, sets, std::move(cells) };
    for (const std::size_t s : sets)
    {
      const FaceSet& set = m_Tags.faceSets[s];
      if (set.info->kind == SetKind::OuterBoundary) continue; // its faces always belong to a tissue interface as well
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
