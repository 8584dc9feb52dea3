// SPDX-License-Identifier: Apache-2.0
#include "HangingPieces.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace surgicalmesher
{
namespace
{

/// Depth-first search of the tetrahedra of a tissue, connected through faces.
class DepthFirst
{
public:
  DepthFirst(const TetMesh& mesh, const AcrossFaces& across)
    : m_Mesh(mesh), m_Across(across), m_Nodes(mesh.tetrahedra.size())
  {
  }

  bool isReached(std::int32_t t) const { return m_Nodes[t].number >= 0; }

  /// Returns the component of `root` in preorder: every tetrahedron is followed by those below it in the search tree.
  std::vector<std::int32_t> componentOf(std::int32_t root)
  {
    std::vector<std::int32_t> order, path;
    enter(root, -1, order, path);
    while (!path.empty())
    {
      const std::int32_t t = path.back();
      if (m_Nodes[t].nextFace < 4) follow(t, m_Nodes[t].nextFace++, order, path);
      else leave(order, path);
    }
    return order;
  }

  void forget(const std::vector<std::int32_t>& component)
  {
    for (const std::int32_t t : component) m_Nodes[t] = {};
  }

  /// Number of tetrahedra in the subtree of this one, itself included.
  std::int32_t sizeAt(std::int32_t t) const { return m_Nodes[t].size; }
  /// Whether the face by which the tetrahedron was entered is a bridge.
  bool hangsOnBridge(std::int32_t t) const { return m_Nodes[t].lowest == m_Nodes[t].number && m_Nodes[t].entry >= 0; }
  int entryFace(std::int32_t t) const { return m_Nodes[t].entry; }

private:
  struct Node
  {
    std::int32_t number = -1, lowest = -1, size = 0; // place in preorder; least place reached from its subtree
    int entry = -1, nextFace = 0;
  };

  void enter(std::int32_t t, std::int32_t from, std::vector<std::int32_t>& order, std::vector<std::int32_t>& path)
  {
    Node& node = m_Nodes[t];
    node.number = node.lowest = std::int32_t(order.size());
    const auto& across = m_Across[t];
    if (from >= 0) node.entry = int(std::find(across.begin(), across.end(), from) - across.begin());
    order.push_back(t);
    path.push_back(t);
  }

  void follow(std::int32_t t, int face, std::vector<std::int32_t>& order, std::vector<std::int32_t>& path)
  {
    const std::int32_t next = m_Across[t][face];
    if (next < 0 || face == m_Nodes[t].entry || m_Mesh.labels[next] != m_Mesh.labels[t]) return;
    if (isReached(next)) m_Nodes[t].lowest = std::min(m_Nodes[t].lowest, m_Nodes[next].number);
    else enter(next, t, order, path);
  }

  void leave(const std::vector<std::int32_t>& order, std::vector<std::int32_t>& path)
  {
    Node& node = m_Nodes[path.back()];
    node.size = std::int32_t(order.size()) - node.number;
    path.pop_back();
    if (path.empty()) return;
    Node& above = m_Nodes[path.back()];
    above.lowest = std::min(above.lowest, node.lowest);
  }

  const TetMesh& m_Mesh;
  const AcrossFaces& m_Across;
  std::vector<Node> m_Nodes;
};

/// Returns a component in preorder from a root below which every bridge has at most half of the tetrahedra.
std::vector<std::int32_t> componentFromItsMiddle(DepthFirst& search, std::int32_t first)
{
  std::vector<std::int32_t> component = search.componentOf(first);
  std::int32_t middle = first;
  for (const std::int32_t t : component)
  {
    if (search.hangsOnBridge(t) && 2 * std::size_t(search.sizeAt(t)) > component.size()) middle = t;
  }
  if (middle == first) return component;
  search.forget(component);
  return search.componentOf(middle);
}

using Piece = std::vector<std::int32_t>::const_iterator;

/// Number of tetrahedra at each point, without those of label 0.
std::vector<std::int32_t> usesOf(const TetMesh& mesh)
{
  std::vector<std::int32_t> uses(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    if (mesh.labels[t] == 0) continue;
    for (const std::int32_t p : mesh.tetrahedra[t]) ++uses[p];
  }
  return uses;
}

/// Whether the piece is attached only by the face opposite this corner of its first tetrahedron.
bool isFree(const TetMesh& mesh, Piece begin, Piece end, int corner, const std::vector<std::int32_t>& uses)
{
  std::map<std::int32_t, std::int32_t> inside;
  for (Piece t = begin; t != end; ++t)
    for (const std::int32_t p : mesh.tetrahedra[*t]) ++inside[p];
  for (int c = 0; c < 4; ++c)
  {
    if (c != corner) inside.erase(mesh.tetrahedra[*begin][c]);
  }
  return std::all_of(inside.begin(), inside.end(),
                     [&](const auto& point) { return point.second == uses[point.first]; });
}

HangingPiece describe(const TetMesh& mesh, Piece begin, Piece end)
{
  HangingPiece piece;
  piece.label = mesh.labels[*begin];
  piece.tetrahedra = std::size_t(end - begin);
  Vec3 moment;
  for (Piece t = begin; t != end; ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[*t];
    const double volume = orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) / 6;
    piece.volume += volume;
    moment += volume / 4 * (mesh.points[a] + mesh.points[b] + mesh.points[c] + mesh.points[d]);
  }
  piece.place = moment / piece.volume;
  return piece;
}

} // namespace

std::vector<HangingPiece> hangingPieces(const TetMesh& mesh, double largestShare)
{
  return hangingPieces(mesh, faceAdjacency(mesh).across, largestShare);
}

std::vector<HangingPiece> hangingPieces(const TetMesh& mesh, const AcrossFaces& across, double largestShare)
{
  std::map<Label, std::size_t> count;
  for (const Label label : mesh.labels) ++count[label];
  const std::vector<std::int32_t> uses = usesOf(mesh);
  DepthFirst search(mesh, across);
  std::vector<HangingPiece> pieces;
  for (std::size_t first = 0; first < mesh.tetrahedra.size(); ++first)
  {
    if (mesh.labels[first] == 0 || search.isReached(std::int32_t(first))) continue;
    const double most = std::max(1.0, largestShare * double(count[mesh.labels[first]]));
    const std::vector<std::int32_t> component = componentFromItsMiddle(search, std::int32_t(first));
    for (Piece t = component.begin(); t != component.end();)
    {
      const bool hangs = search.hangsOnBridge(*t) && search.sizeAt(*t) <= most;
      const Piece end = t + (hangs ? search.sizeAt(*t) : 1);
      if (hangs)
      {
        pieces.push_back(describe(mesh, t, end));
        pieces.back().isFree = isFree(mesh, t, end, search.entryFace(*t), uses);
      }
      t = end;
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const HangingPiece& a, const HangingPiece& b)
                   { return std::tie(a.isFree, a.volume) > std::tie(b.isFree, b.volume); });
  return pieces;
}

} // namespace surgicalmesher
