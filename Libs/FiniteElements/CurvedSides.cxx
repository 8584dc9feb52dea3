// SPDX-License-Identifier: Apache-2.0
#include "CurvedSides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace surgicalmesher
{
namespace
{

constexpr double kLeastJacobian = 0.3;
constexpr double kFarthest = 0.15;            ///< relative to the length of the edge
constexpr double kSharpCosine = 0.7660444431; ///< of 40 degrees

/// The corners at the ends of each mid-side node of a tetrahedron, from the fifth node on; the first three also apply
/// to triangles.
constexpr int kEnds[6][2] = { { 0, 1 }, { 1, 2 }, { 0, 2 }, { 0, 3 }, { 1, 3 }, { 2, 3 } };

/// Index, among the nodes of a tetrahedron, of the mid-side node between two corners.
constexpr int kMiddle[4][4] = { { -1, 4, 6, 7 }, { 4, -1, 5, 8 }, { 6, 5, -1, 9 }, { 7, 8, 9, -1 } };

/// An edge of a boundary: its ends and the boundary's triangles there.
struct BoundaryEdge
{
  std::int32_t ends[2];
  std::vector<std::size_t> triangles;
};

/// The boundary between two tissues.
class Boundary
{
public:
  Boundary(const std::vector<Cell>& triangles, const std::vector<Vec3>& points) : m_Points(points)
  {
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      const Cell& nodes = triangles[t];
      m_Normals.push_back(cross(points[nodes[1]] - points[nodes[0]], points[nodes[2]] - points[nodes[0]]));
      for (int i = 0; i < 3; ++i)
      {
        m_About[nodes[i]].push_back(t);
        BoundaryEdge& edge = m_Edges[nodes[3 + i]];
        edge.ends[0] = nodes[kEnds[i][0]];
        edge.ends[1] = nodes[kEnds[i][1]];
        edge.triangles.push_back(t);
      }
    }
  }

  /// Returns the edges by their mid-side nodes.
  const std::map<std::int32_t, BoundaryEdge>& edges() const { return m_Edges; }

  /// Returns the displacement of the midpoint of an edge; zero if the edge is to stay straight.
  Vec3 offset(const BoundaryEdge& edge) const
  {
    if (edge.triangles.size() != 2) return {};
    const Vec3 first = m_Normals[edge.triangles[0]], second = m_Normals[edge.triangles[1]];
    if (dot(first, second) < kSharpCosine * norm(first) * norm(second)) return {};
    const Vec3 across = first / norm(first) + second / norm(second);
    const Vec3 along = m_Points[edge.ends[1]] - m_Points[edge.ends[0]];
    const Vec3 begin = normalAt(edge.ends[0], across), end = normalAt(edge.ends[1], across);
    const Vec3 result = 0.125 * (dot(along, end) * end - dot(along, begin) * begin);
    return norm(result) <= kFarthest * norm(along) ? result : Vec3{};
  }

private:
  /// Returns the unit normal at a point from the triangles around it whose normals are close to `across`.
  Vec3 normalAt(std::int32_t point, const Vec3& across) const
  {
    Vec3 sum;
    for (const std::size_t t : m_About.at(point))
    {
      if (dot(m_Normals[t], across) >= kSharpCosine * norm(m_Normals[t]) * norm(across)) sum = sum + m_Normals[t];
    }
    const double length = norm(sum);
    return length > 0 ? sum / length : Vec3{};
  }

  const std::vector<Vec3>& m_Points;
  std::vector<Vec3> m_Normals; ///< length: twice the area
  std::map<std::int32_t, std::vector<std::size_t>> m_About;
  std::map<std::int32_t, BoundaryEdge> m_Edges;
};

/// Returns the new positions of mid-side nodes.
std::map<std::int32_t, Vec3> curvedPlaces(const FiniteElementModel& model)
{
  const std::vector<Vec3>& points = model.content.mesh.points;
  std::map<std::int32_t, Vec3> places;
  std::set<std::int32_t> seen;
  for (const SurfaceSet& surface : model.surfaces)
  {
    if (surface.kind != SetKind::TissueInterface || surface.ids[0] < surface.ids[1]) continue; // one of the two sides
    const Boundary boundary(surface.cells, points);
    for (const auto& [middle, edge] : boundary.edges())
    {
      if (!seen.insert(middle).second) places.erase(middle); // several boundaries meet here
      else if (const Vec3 offset = boundary.offset(edge); norm(offset) > 0) places[middle] = points[middle] + offset;
    }
  }
  return places;
}

/// Returns the derivatives of the position at a corner with respect to the second to fourth barycentric coordinates;
/// the first is eliminated.
std::array<Vec3, 3> derivativesAt(int corner, const Cell& nodes, const std::vector<Vec3>& points)
{
  const auto by = [&](int i)
  {
    if (i == corner) return 3 * points[nodes[i]];
    return 4 * points[nodes[kMiddle[i][corner]]] - points[nodes[i]];
  };
  const Vec3 first = by(0);
  return { by(1) - first, by(2) - first, by(3) - first };
}

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(cross(a, b), c); }

} // namespace

double leastJacobian(const Cell& tetrahedron, const std::vector<Vec3>& points)
{
  std::array<std::array<Vec3, 3>, 4> at;
  for (int corner = 0; corner < 4; ++corner) at[corner] = derivativesAt(corner, tetrahedron, points);
  // The derivatives are linear in the barycentric coordinates, so that the determinant is the sum over i, j and k of
  // the product of these coordinates and this determinant. A Bernstein coefficient is the mean over the permutations of
  // three indices.
  std::map<std::array<int, 3>, std::pair<double, int>> sums;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
      {
        std::array<int, 3> three{ i, j, k };
        std::sort(three.begin(), three.end());
        auto& [sum, count] = sums[three];
        sum += determinant(at[i][0], at[j][1], at[k][2]);
        ++count;
      }
  const Vec3& o = points[tetrahedron[0]];
  const double straight =
    determinant(points[tetrahedron[1]] - o, points[tetrahedron[2]] - o, points[tetrahedron[3]] - o);
  double least = HUGE_VAL;
  for (const auto& [three, mean] : sums) least = std::min(least, mean.first / mean.second / straight);
  return least;
}

FiniteElementModel withCurvedSides(FiniteElementModel model)
{
  std::vector<Vec3>& points = model.content.mesh.points;
  std::map<std::int32_t, Vec3> straight; // straight positions of the nodes moved so far
  for (const auto& [middle, place] : curvedPlaces(model)) straight[middle] = std::exchange(points[middle], place);
  for (bool changed = true; changed;)
  {
    changed = false;
    for (const Cell& nodes : model.elements)
    {
      const bool isCurved =
        std::any_of(nodes.begin() + 4, nodes.end(), [&](std::int32_t id) { return straight.count(id) != 0; });
      if (!isCurved || leastJacobian(nodes, points) >= kLeastJacobian) continue;
      for (const std::int32_t* id = nodes.begin() + 4; id != nodes.end(); ++id)
      {
        const auto found = straight.find(*id);
        if (found == straight.end()) continue;
        points[*id] = found->second;
        straight.erase(found);
        changed = true;
      }
    }
  }
  return model;
}

} // namespace surgicalmesher
