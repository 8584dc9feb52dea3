// SPDX-License-Identifier: Apache-2.0
#include "SecondOrder.h"

#include "ConstitutiveTags.h"

#include <algorithm>
#include <utility>

namespace surgicalmesher
{
namespace
{

using Edge = std::pair<std::int32_t, std::int32_t>;

constexpr int kEdges[6][2] = { { 0, 1 }, { 1, 2 }, { 0, 2 }, { 0, 3 }, { 1, 3 }, { 2, 3 } };

std::vector<Edge> edgesOf(const std::vector<Cell>& elements)
{
  std::vector<Edge> edges;
  for (const Cell& element : elements)
  {
    for (const auto& [a, b] : kEdges) edges.push_back(std::minmax({ element[a], element[b] }));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Appends mid-side nodes to cells.
class MidSideNodes
{
public:
  MidSideNodes(const std::vector<Cell>& elements, std::size_t corners)
    : m_Edges(edgesOf(elements)), m_First(static_cast<std::int32_t>(corners))
  {
  }

  const std::vector<Edge>& edges() const { return m_Edges; }

  /// Appends to tetrahedra or triangles.
  void addTo(std::vector<Cell>& cells) const
  {
    for (Cell& cell : cells)
    {
      const Cell corners = cell;
      for (int e = 0; e < (corners.size() == 4 ? 6 : 3); ++e)
        cell.append(between(corners[kEdges[e][0]], corners[kEdges[e][1]]));
    }
  }

  /// Returns the mid-side nodes of edges whose two ends are in `corners`, which must be ascending.
  std::vector<std::int32_t> among(const std::vector<std::int32_t>& corners) const
  {
    const auto isIn = [&](std::int32_t id) { return std::binary_search(corners.begin(), corners.end(), id); };
    std::vector<std::int32_t> ids;
    for (std::size_t e = 0; e < m_Edges.size(); ++e)
    {
      if (isIn(m_Edges[e].first) && isIn(m_Edges[e].second)) ids.push_back(m_First + static_cast<std::int32_t>(e));
    }
    return ids;
  }

private:
  std::int32_t between(std::int32_t a, std::int32_t b) const
  {
    const auto place = std::lower_bound(m_Edges.begin(), m_Edges.end(), Edge(std::minmax({ a, b })));
    return m_First + static_cast<std::int32_t>(place - m_Edges.begin());
  }

  std::vector<Edge> m_Edges; ///< ascending
  std::int32_t m_First;
};

void addPoints(MeshFile& content, const std::vector<Edge>& edges)
{
  std::vector<Vec3>& points = content.mesh.points;
  const bool hasLengths = !content.targetEdgeLength.empty();
  for (const auto& [a, b] : edges)
  {
    points.push_back(0.5 * (points[a] + points[b]));
    if (hasLengths)
      content.targetEdgeLength.push_back(0.5 * (content.targetEdgeLength[a] + content.targetEdgeLength[b]));
  }
  content.subMeshInterface.clear();
  content.volumePointId.clear();
  content.interfaceId.clear();
}

/// Returns the members of a set for a model whose elements and surfaces already have their mid-side nodes.
std::vector<std::int32_t> membersOf(const NodeSet& set, const FiniteElementModel& model, const MidSideNodes& nodes)
{
  if (set.kind == SetKind::Named)
  {
    std::vector<std::int32_t> ids = set.points;
    const std::vector<std::int32_t> middles = nodes.among(set.points);
    ids.insert(ids.end(), middles.begin(), middles.end());
    return ids;
  }
  const MeshFile& content = model.content;
  if (set.kind == SetKind::SubMeshInterface && set.ids.empty())
    return nodesOfSeveral(model.elements, content.mesh.points.size(), content.subMesh);
  std::vector<Cell> cells;
  if (set.kind == SetKind::NullDisplacement)
  {
    for (std::size_t e = 0; e < model.elements.size(); ++e)
      if (content.constitutive[e] == kNullDisplacement) cells.push_back(model.elements[e]);
  }
  for (const SurfaceSet& surface : model.surfaces)
    if (surface.nodeSet == set.name) cells = surface.cells;
  return nodesOf(cells);
}

} // namespace

FiniteElementModel withMidSideNodes(FiniteElementModel model)
{
  const MidSideNodes nodes(model.elements, model.content.mesh.points.size());
  addPoints(model.content, nodes.edges());
  nodes.addTo(model.elements);
  for (SurfaceSet& surface : model.surfaces) nodes.addTo(surface.cells);
  for (Shell& shell : model.shells) nodes.addTo(shell.cells);
  for (NodeSet& set : model.nodeSets) set.points = membersOf(set, model, nodes);
  return model;
}

} // namespace surgicalmesher
