// SPDX-License-Identifier: Apache-2.0
#include "MeshChecks.h"

#include "Errors.h"
#include "FaceAdjacency.h"
#include "Grouped.h"
#include "Parallel.h"
#include "UnionFind.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <tuple>

namespace surgicalmesher
{
namespace
{

// ---- surfaces -------------------------------------------------------------------------------------------------------

/// An edge of a triangle in the boundary of one tissue, which lies on one side of the triangle.
struct Side
{
  Label tissue;
  std::int32_t low, high; ///< point ids
  std::uint32_t node;     ///< 6 * triangle + 3 * side + corner at which the edge starts
  bool ascending;         ///< the edge runs from low to high if the triangle is oriented with the tissue behind it
};

std::vector<Side> sidesOf(const SurfaceComplex& surface)
{
  std::vector<Side> sides;
  sides.reserve(6 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.labels[t][0] == surface.labels[t][1]) continue;
    for (int side = 0; side < 2; ++side)
    {
      if (surface.labels[t][side] == 0) continue;
      for (int c = 0; c < 3; ++c)
      {
        const std::int32_t from = surface.triangles[t][c];
        const std::int32_t to = surface.triangles[t][(c + 1) % 3];
        sides.push_back({ surface.labels[t][side], std::min(from, to), std::max(from, to),
                          static_cast<std::uint32_t>(6 * t + 3 * side + c), (from < to) == (side == 0) });
      }
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b)
            { return std::tie(a.tissue, a.low, a.high, a.node) < std::tie(b.tissue, b.low, b.high, b.node); });
  return sides;
}

std::uint32_t cornerAt(const SurfaceComplex& surface, std::uint32_t node, std::int32_t point)
{
  const std::uint32_t first = node - node % 3;
  const auto& triangle = surface.triangles[node / 6];
  return first + static_cast<std::uint32_t>(std::find(triangle.begin(), triangle.end(), point) - triangle.begin());
}

void countEdges(const SurfaceComplex& surface, const std::vector<Side>& sides, UnionFind& fans,
                std::map<Label, TissueSurface>& result)
{
  for (std::size_t begin = 0, end; begin < sides.size(); begin = end)
  {
    const Side& first = sides[begin];
    int balance = 0;
    for (end = begin; end < sides.size() && sides[end].tissue == first.tissue && sides[end].low == first.low &&
                      sides[end].high == first.high;
         ++end)
    {
      balance += sides[end].ascending ? 1 : -1;
      fans.unite(cornerAt(surface, first.node, first.low), cornerAt(surface, sides[end].node, first.low));
      fans.unite(cornerAt(surface, first.node, first.high), cornerAt(surface, sides[end].node, first.high));
    }
    TissueSurface& tissue = result[first.tissue];
    const Vec3 middle = 0.5 * (surface.points[first.low] + surface.points[first.high]);
    const std::int32_t triangle = static_cast<std::int32_t>(first.node / 6);
    if ((end - begin) % 2 == 1) tissue.openEdges.add(middle, triangle);
    else if (balance != 0) tissue.misorientedEdges.add(middle, triangle);
    if (end - begin > 2) tissue.nonManifoldEdges.add(middle, triangle);
    --tissue.euler;
  }
}

void countVertices(const SurfaceComplex& surface, const std::vector<Side>& sides, UnionFind& fans,
                   std::map<Label, TissueSurface>& result)
{
  std::vector<std::tuple<Label, std::int32_t, std::uint32_t>> corners;
  corners.reserve(sides.size());
  for (const Side& side : sides)
  {
    corners.emplace_back(side.tissue, surface.triangles[side.node / 6][side.node % 3], fans.find(side.node));
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const auto& [label, point, fan] = corners[i];
    const auto same = [&](std::size_t j) {
      return std::get<0>(corners[j]) == std::get<0>(corners[i]) && std::get<1>(corners[j]) == std::get<1>(corners[i]);
    };
    TissueSurface& tissue = result[label];
    if (i == 0 || !same(i - 1)) ++tissue.euler;
    else if (i < 2 || !same(i - 2)) tissue.nonManifoldVertices.add(surface.points[point], point);
  }
}

// ---- tetrahedra -----------------------------------------------------------------------------------------------------

Vec3 centreOf(const TetMesh& mesh, std::size_t t)
{
  const auto& ids = mesh.tetrahedra[t];
  return 0.25 * (mesh.points[ids[0]] + mesh.points[ids[1]] + mesh.points[ids[2]] + mesh.points[ids[3]]);
}

/// The open interior of each tissue: the cells (tetrahedra, faces, edges, points) whose surrounding tetrahedra all have
/// its label and that are not on the hull of the mesh.
class InteriorCells
{
public:
  InteriorCells(const TetMesh& mesh, const FaceAdjacency& neighbours) : m_Mesh(mesh), m_Neighbours(neighbours)
  {
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    {
      for (int f = 0; f < 4; ++f)
      {
        if (neighbours.across[t][f] >= 0) continue;
        for (int c = 0; c < 3; ++c)
        {
          const std::int32_t point = mesh.tetrahedra[t][kFaceCorners[f][c]];
          const std::int32_t next = mesh.tetrahedra[t][kFaceCorners[f][(c + 1) % 3]];
          m_HullPoints.insert(point);
          m_HullEdges.emplace(std::min(point, next), std::max(point, next));
        }
      }
    }
  }

  /// Euler number of each tissue, as the alternating sum over its open interior.
  std::map<Label, int> euler() const
  {
    std::map<Label, int> result;
    for (const Label label : m_Mesh.labels) ++result[label];
    addFaces(result);
    addEdges(result);
    addPoints(result);
    return result;
  }

private:
  void addFaces(std::map<Label, int>& result) const
  {
    for (std::size_t t = 0; t < m_Mesh.tetrahedra.size(); ++t)
    {
      for (const std::int32_t beyond : m_Neighbours.across[t])
      {
        if (beyond > static_cast<std::int32_t>(t) && m_Mesh.labels[beyond] == m_Mesh.labels[t])
          --result[m_Mesh.labels[t]];
      }
    }
  }

  void addEdges(std::map<Label, int>& result) const
  {
    using Edge = std::pair<std::int32_t, Label>; // its higher point, and the label of a tetrahedron at it
    Grouped<Edge> edges(m_Mesh.points.size(),
                        [&](auto&& visit)
                        {
                          for (std::size_t t = 0; t < m_Mesh.tetrahedra.size(); ++t)
                            for (const auto& [a, b] : kEdgeCorners)
                            {
                              const auto [low, high] = std::minmax(m_Mesh.tetrahedra[t][a], m_Mesh.tetrahedra[t][b]);
                              visit(std::size_t(low), Edge{ high, m_Mesh.labels[t] });
                            }
                        });
    for (std::size_t low = 0; low < edges.groups(); ++low)
    {
      std::sort(edges.begin(low), edges.end(low));
      const Edge* const end = std::unique(edges.begin(low), edges.end(low));
      for (const Edge *edge = edges.begin(low), *next; edge != end; edge = next)
      {
        const auto& [high, label] = *edge;
        for (next = edge + 1; next != end && next->first == high;) ++next;
        if (next - edge == 1 && m_HullEdges.count({ std::int32_t(low), high }) == 0) ++result[label];
      }
    }
  }

  void addPoints(std::map<Label, int>& result) const
  {
    constexpr std::int32_t unseen = -1, several = -2;
    std::vector<std::int32_t> labelAt(m_Mesh.points.size(), unseen);
    for (std::size_t t = 0; t < m_Mesh.tetrahedra.size(); ++t)
    {
      for (const std::int32_t id : m_Mesh.tetrahedra[t])
      {
        if (labelAt[id] == unseen) labelAt[id] = m_Mesh.labels[t];
        else if (labelAt[id] != m_Mesh.labels[t]) labelAt[id] = several;
      }
    }
    for (std::size_t i = 0; i < labelAt.size(); ++i)
    {
      if (labelAt[i] >= 0 && m_HullPoints.count(static_cast<std::int32_t>(i)) == 0)
        --result[static_cast<Label>(labelAt[i])];
    }
  }

  const TetMesh& m_Mesh;
  const FaceAdjacency& m_Neighbours;
  std::set<std::int32_t> m_HullPoints;
  std::set<std::pair<std::int32_t, std::int32_t>> m_HullEdges;
};

bool passable(const TetMesh& mesh, const FaceAdjacency& neighbours, std::size_t t, int f)
{
  const std::int32_t beyond = neighbours.across[t][f];
  return beyond >= 0 && mesh.labels[beyond] == mesh.labels[t];
}

/// Number of connected boundary surfaces of each tissue, seen from inside. The nodes 4 t + c are the corners of
/// tetrahedra: the corners of one tissue at one point are joined where their tetrahedra share a face, which gives
/// sectors; boundary triangles join the sectors at their three points.
std::map<Label, int> boundarySurfaces(const TetMesh& mesh, const FaceAdjacency& neighbours)
{
  UnionFind sectors(4 * mesh.tetrahedra.size());
  const auto eachFace = [&](const std::function<void(std::size_t t, int f)>& visit)
  {
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    {
      for (int f = 0; f < 4; ++f) visit(t, f);
    }
  };
  eachFace(
    [&](std::size_t t, int f)
    {
      if (!passable(mesh, neighbours, t, f)) return;
      const std::int32_t beyond = neighbours.across[t][f];
      for (const int c : kFaceCorners[f])
      {
        const auto& other = mesh.tetrahedra[beyond];
        const auto match = std::find(other.begin(), other.end(), mesh.tetrahedra[t][c]) - other.begin();
        sectors.unite(static_cast<std::uint32_t>(4 * t + c), static_cast<std::uint32_t>(4 * beyond + match));
      }
    });
  std::set<std::pair<Label, std::uint32_t>> surfaces;
  eachFace(
    [&](std::size_t t, int f)
    {
      if (passable(mesh, neighbours, t, f)) return;
      const std::uint32_t first = static_cast<std::uint32_t>(4 * t);
      sectors.unite(first + kFaceCorners[f][0], first + kFaceCorners[f][1]);
      sectors.unite(first + kFaceCorners[f][0], first + kFaceCorners[f][2]);
    });
  eachFace(
    [&](std::size_t t, int f)
    {
      if (passable(mesh, neighbours, t, f)) return;
      surfaces.emplace(mesh.labels[t], sectors.find(static_cast<std::uint32_t>(4 * t + kFaceCorners[f][0])));
    });
  std::map<Label, int> result;
  for (const auto& [label, root] : surfaces) ++result[label];
  return result;
}

void requireNone(const Defect& defect, const std::string& stage, const std::string& what)
{
  if (defect.count == 0) return;
  throw EngineError(stage + ": " + std::to_string(defect.count) + " " + what + ", the first at " + place(defect.where));
}

} // namespace

std::map<Label, TissueSurface> checkSurface(const SurfaceComplex& surface)
{
  std::map<Label, TissueSurface> result;
  const std::vector<Side> sides = sidesOf(surface);
  UnionFind fans(6 * surface.triangles.size());
  countEdges(surface, sides, fans, result);
  countVertices(surface, sides, fans, result);
  const Vec3 origin = surface.points.empty() ? Vec3() : surface.points.front();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const double volume = orient(origin, surface.points[a], surface.points[b], surface.points[c]) / 6;
    for (int side = 0; side < 2; ++side)
    {
      if (surface.labels[t][0] == surface.labels[t][1] || surface.labels[t][side] == 0) continue;
      TissueSurface& tissue = result[surface.labels[t][side]];
      tissue.volume += side == 0 ? volume : -volume;
      ++tissue.triangles;
      ++tissue.euler;
    }
  }
  return result;
}

namespace
{

MeshDefects checkMesh(const TetMesh& mesh, const FaceAdjacency& neighbours)
{
  MeshDefects result;
  std::vector<bool> used(mesh.points.size(), false);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    for (const std::int32_t id : mesh.tetrahedra[t]) used[id] = true;
    const double volume = orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
    if (!(volume > 0)) result.invertedOrFlat.add(centreOf(mesh, t), static_cast<std::int32_t>(t));
  }
  for (const std::int32_t t : neighbours.overused) result.overusedFaces.add(centreOf(mesh, t), t);
  std::set<std::tuple<double, double, double>> places;
  for (std::size_t i = 0; i < used.size(); ++i)
  {
    const Vec3& p = mesh.points[i];
    if (!used[i]) result.unusedPoints.add(p, static_cast<std::int32_t>(i));
    if (!places.emplace(p.x, p.y, p.z).second) result.duplicatePoints.add(p, static_cast<std::int32_t>(i));
  }
  return result;
}

} // namespace

MeshDefects checkMesh(const TetMesh& mesh) { return checkMesh(mesh, faceAdjacency(mesh)); }

std::map<Label, Betti> meshTopology(const TetMesh& mesh)
{
  const FaceAdjacency neighbours = faceAdjacency(mesh);
  std::vector<std::int32_t> region;
  std::map<Label, int> surfaces, euler;
  runInParallel({
    [&] { region = faceRegions(neighbours, [&](std::int32_t t, int f) { return passable(mesh, neighbours, t, f); }); },
    [&] { surfaces = boundarySurfaces(mesh, neighbours); },
    [&] { euler = InteriorCells(mesh, neighbours).euler(); },
  });
  std::map<Label, Betti> result;
  std::int32_t regionsSeen = 0;
  for (std::size_t t = 0; t < region.size(); ++t)
  {
    if (region[t] < regionsSeen) continue;
    ++regionsSeen;
    ++result[mesh.labels[t]].components;
  }
  result.erase(0);
  for (auto& [label, betti] : result)
  {
    betti.cavities = surfaces.at(label) - betti.components; // each component has one outer surface
    betti.tunnels = betti.components + betti.cavities - euler.at(label);
  }
  return result;
}

void requireSound(const SurfaceComplex& surface, const std::string& stage)
{
  for (const auto& [label, tissue] : checkSurface(surface))
  {
    const std::string whose = " in the surface of tissue " + std::to_string(label);
    requireNone(tissue.openEdges, stage, "open edges" + whose);
    requireNone(tissue.misorientedEdges, stage, "edges with mismatched sides" + whose);
    requireNone(tissue.nonManifoldEdges, stage, "non-manifold edges" + whose);
    requireNone(tissue.nonManifoldVertices, stage, "non-manifold points" + whose);
  }
}

void requireSound(const TetMesh& mesh, const std::string& stage)
{
  const FaceAdjacency neighbours = faceAdjacency(mesh);
  const auto checkTetrahedra = [&]
  {
    const MeshDefects defects = checkMesh(mesh, neighbours);
    requireNone(defects.invertedOrFlat, stage, "inverted or flat tetrahedra");
    requireNone(defects.overusedFaces, stage, "tetrahedra with a face that more than two share");
    requireNone(defects.unusedPoints, stage, "points of no tetrahedron");
    requireNone(defects.duplicatePoints, stage, "points on top of another");
  };
  // If both fail, the first is reported: the second check may depend on what the first requires.
  runInParallel({ checkTetrahedra, [&] { requireSound(interfaceOf(mesh, neighbours.across), stage); } });
}

} // namespace surgicalmesher
