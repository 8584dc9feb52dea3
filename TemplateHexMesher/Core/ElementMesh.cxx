// SPDX-License-Identifier: Apache-2.0
#include "ElementMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace surgicalmesher
{
namespace
{

struct Topology
{
  int nodes;
  bool volume;
  std::vector<Face> sides; ///< local nodes, counter-clockwise seen from outside
  std::vector<std::array<int, 2>> edges;
};

const Topology& topologyOf(ElementShape shape)
{
  static const std::array<Topology, 5> topologies{ {
    { 3, false, { { { 0, 1, 2, 0 }, 3 } }, { { 0, 1 }, { 1, 2 }, { 2, 0 } } },
    { 4, false, { { { 0, 1, 2, 3 }, 4 } }, { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } } },
    { 4,
      true,
      { { { 0, 2, 1, 0 }, 3 }, { { 0, 1, 3, 0 }, 3 }, { { 1, 2, 3, 0 }, 3 }, { { 2, 0, 3, 0 }, 3 } },
      { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 1, 3 }, { 2, 3 } } },
    { 6,
      true,
      { { { 0, 2, 1, 0 }, 3 },
        { { 3, 4, 5, 0 }, 3 },
        { { 0, 1, 4, 3 }, 4 },
        { { 1, 2, 5, 4 }, 4 },
        { { 2, 0, 3, 5 }, 4 } },
      { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 3, 4 }, { 4, 5 }, { 5, 3 }, { 0, 3 }, { 1, 4 }, { 2, 5 } } },
    { 8,
      true,
      { { { 0, 3, 2, 1 }, 4 },
        { { 4, 5, 6, 7 }, 4 },
        { { 0, 1, 5, 4 }, 4 },
        { { 1, 2, 6, 5 }, 4 },
        { { 2, 3, 7, 6 }, 4 },
        { { 3, 0, 4, 7 }, 4 } },
      { { 0, 1 },
        { 1, 2 },
        { 2, 3 },
        { 3, 0 },
        { 4, 5 },
        { 5, 6 },
        { 6, 7 },
        { 7, 4 },
        { 0, 4 },
        { 1, 5 },
        { 2, 6 },
        { 3, 7 } } },
  } };
  return topologies[std::size_t(shape)];
}

Face globalFace(const Face& local, const Element& element)
{
  Face face;
  face.size = local.size;
  for (int i = 0; i < local.size; ++i) face.nodes[i] = element.nodes[local.nodes[i]];
  return face;
}

/// Key of a face; the same in both elements that share the face.
std::array<std::int32_t, 4> keyOf(const Face& face)
{
  std::array<std::int32_t, 4> key = face.nodes;
  if (face.size == 3) key[3] = -1;
  std::sort(key.begin(), key.end());
  return key;
}

} // namespace

int nodeCount(ElementShape shape) { return topologyOf(shape).nodes; }
bool isVolume(ElementShape shape) { return topologyOf(shape).volume; }

std::vector<Face> outerFaces(const std::vector<Element>& elements)
{
  const bool hasVolume = std::any_of(elements.begin(), elements.end(), [](const Element& e) { return isVolume(e); });
  std::vector<Face> faces;
  for (const Element& element : elements)
  {
    if (isVolume(element) != hasVolume) continue;
    for (const Face& side : topologyOf(element.shape).sides) faces.push_back(globalFace(side, element));
  }
  if (!hasVolume) return faces;
  std::map<std::array<std::int32_t, 4>, int> count;
  for (const Face& face : faces) ++count[keyOf(face)];
  std::vector<Face> outer;
  for (const Face& face : faces)
  {
    if (count[keyOf(face)] == 1) outer.push_back(face);
  }
  return outer;
}

std::vector<Triangle> trianglesOf(const std::vector<Face>& faces, const Points& points)
{
  std::vector<Triangle> triangles;
  for (const Face& face : faces)
  {
    const auto& n = face.nodes;
    const auto length = [&](int a, int b) { return (points.col(n[a]) - points.col(n[b])).squaredNorm(); };
    if (face.size == 3) triangles.push_back({ n[0], n[1], n[2] });
    else if (length(0, 2) <= length(1, 3))
    {
      triangles.push_back({ n[0], n[1], n[2] });
      triangles.push_back({ n[0], n[2], n[3] });
    }
    else
    {
      triangles.push_back({ n[0], n[1], n[3] });
      triangles.push_back({ n[1], n[2], n[3] });
    }
  }
  return triangles;
}

std::vector<std::array<std::int32_t, 2>> edgesOf(const std::vector<Element>& elements)
{
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const Element& element : elements)
  {
    for (const auto& edge : topologyOf(element.shape).edges)
    {
      const auto ends = std::minmax(element.nodes[edge[0]], element.nodes[edge[1]]);
      edges.push_back({ ends.first, ends.second });
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

TriangleSurface compacted(const Points& points, const std::vector<Triangle>& triangles)
{
  std::vector<std::int32_t> newId(points.cols(), -1);
  for (const Triangle& triangle : triangles)
  {
    for (const std::int32_t id : triangle) newId[id] = 0;
  }
  std::int32_t count = 0;
  for (std::int32_t& id : newId)
  {
    if (id == 0) id = count++;
  }
  TriangleSurface surface{ Points(3, count), triangles };
  for (std::size_t i = 0; i < newId.size(); ++i)
  {
    if (newId[i] >= 0) surface.points.col(newId[i]) = points.col(Eigen::Index(i));
  }
  for (Triangle& triangle : surface.triangles)
  {
    for (std::int32_t& id : triangle) id = newId[id];
  }
  return surface;
}

double volumeOf(const Element& element, const Points& points)
{
  if (!isVolume(element)) return 0;
  const Eigen::Vector3d origin = points.col(element.nodes[0]);
  const auto p = [&](std::int32_t id) -> Eigen::Vector3d { return points.col(id) - origin; };
  double sixfold = 0;
  for (const Face& side : topologyOf(element.shape).sides)
  {
    const Face face = globalFace(side, element);
    for (int i = 1; i + 1 < face.size; ++i)
    {
      sixfold += p(face.nodes[0]).cross(p(face.nodes[i])).dot(p(face.nodes[i + 1]));
    }
  }
  return sixfold / 6;
}

} // namespace surgicalmesher
