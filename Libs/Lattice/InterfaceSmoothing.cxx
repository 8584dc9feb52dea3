// SPDX-License-Identifier: Apache-2.0
#include "InterfaceSmoothing.h"

#include "TetQuality.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace surgicalmesher
{

namespace
{

/// For each interface vertex, the neighbours over which its position is averaged.
struct InterfaceGraph
{
  std::vector<std::int32_t> vertices;   ///< point ids, ascending
  std::vector<std::int32_t> start;      ///< CSR over `vertices`
  std::vector<std::int32_t> neighbours; ///< indices into `vertices`
};

InterfaceGraph makeGraph(const KuhnLattice& lattice)
{
  struct Edge
  {
    std::int32_t a, b;
    bool operator<(const Edge& e) const { return a != e.a ? a < e.a : b < e.b; }
    bool operator==(const Edge& e) const { return a == e.a && b == e.b; }
  };
  InterfaceGraph graph;
  std::vector<std::int32_t> local(lattice.background.mesh.points.size(), -1);
  const auto corners = [&](const std::pair<std::int32_t, std::int32_t>& face)
  {
    const auto& t = lattice.background.mesh.tetrahedra[face.first];
    return std::array<std::int32_t, 3>{ t[(face.second + 1) & 3], t[(face.second + 2) & 3], t[(face.second + 3) & 3] };
  };
  for (const auto& f : lattice.interfaceFaces)
    for (std::int32_t v : corners(f)) local[v] = 0;
  for (std::int32_t v = 0; v < std::int32_t(local.size()); ++v)
    if (local[v] == 0)
    {
      local[v] = std::int32_t(graph.vertices.size());
      graph.vertices.push_back(v);
    }
  std::vector<Edge> edges;
  edges.reserve(lattice.interfaceFaces.size() * 3);
  for (const auto& f : lattice.interfaceFaces)
  {
    const auto c = corners(f);
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t a = local[c[i]], b = local[c[(i + 1) % 3]];
      edges.push_back({ std::min(a, b), std::max(a, b) });
    }
  }
  vtkSMPTools::Sort(edges.begin(), edges.end());
  // An edge with three or more faces is part of a curve between three or more labels.
  const std::size_t n = graph.vertices.size();
  std::vector<std::uint8_t> curveDegree(n, 0);
  std::vector<std::pair<Edge, bool>> unique;
  for (std::size_t i = 0; i < edges.size();)
  {
    std::size_t j = i;
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    const bool curve = j - i > 2;
    unique.push_back({ edges[i], curve });
    if (curve)
      for (std::int32_t v : { edges[i].a, edges[i].b }) curveDegree[v] = std::uint8_t(std::min(3, curveDegree[v] + 1));
    i = j;
  }
  const auto follows = [&](std::int32_t v, bool curve)
  { return curveDegree[v] == 0 || (curveDegree[v] == 2 && curve); };
  graph.start.assign(n + 1, 0);
  for (const auto& [e, curve] : unique)
  {
    graph.start[e.a + 1] += follows(e.a, curve);
    graph.start[e.b + 1] += follows(e.b, curve);
  }
  for (std::size_t v = 0; v < n; ++v) graph.start[v + 1] += graph.start[v];
  graph.neighbours.resize(graph.start[n]);
  std::vector<std::int32_t> at(graph.start.begin(), graph.start.end() - 1);
  for (const auto& [e, curve] : unique)
  {
    if (follows(e.a, curve)) graph.neighbours[at[e.a]++] = e.b;
    if (follows(e.b, curve)) graph.neighbours[at[e.b]++] = e.a;
  }
  return graph;
}

std::vector<Vec3> taubin(const InterfaceGraph& graph, const std::vector<Vec3>& points, const Vec3& box,
                         const SmoothingOptions& options)
{
  const std::size_t n = graph.vertices.size();
  std::vector<Vec3> position(n), next(n);
  for (std::size_t v = 0; v < n; ++v) position[v] = points[graph.vertices[v]];
  for (int step = 0; step < 2 * options.iterations; ++step)
  {
    const double weight = step % 2 ? options.grow : options.shrink;
    vtkSMPTools::For(0, vtkIdType(n),
                     [&](vtkIdType begin, vtkIdType end)
                     {
                       for (vtkIdType v = begin; v < end; ++v)
                       {
                         next[v] = position[v];
                         const std::int32_t from = graph.start[v], to = graph.start[v + 1];
                         if (from == to) continue;
                         Vec3 mean;
                         for (std::int32_t k = from; k < to; ++k) mean += position[graph.neighbours[k]];
                         next[v] += weight * (mean / double(to - from) - position[v]);
                         const Vec3& home = points[graph.vertices[v]];
                         for (int a = 0; a < 3; ++a)
                           next[v][a] = std::clamp(next[v][a], home[a] - box[a], home[a] + box[a]);
                       }
                     });
    position.swap(next);
  }
  return position;
}

/// Moves each sample with its face: by `share` times the displacement of the face's corners, interpolated at the
/// sample.
void moveSamples(BackgroundMesh& background, const InterfaceGraph& graph, const std::vector<Vec3>& target, double share)
{
  const auto& points = background.mesh.points;
  std::vector<Vec3> way(points.size());
  for (std::size_t i = 0; i < graph.vertices.size(); ++i)
    way[graph.vertices[i]] = target[i] - points[graph.vertices[i]];
  const auto move = [&](BackgroundMesh::Sample& e)
  {
    const auto& t = background.mesh.tetrahedra[e.tetrahedron];
    const std::int32_t a = t[(e.face + 1) & 3], b = t[(e.face + 2) & 3], c = t[(e.face + 3) & 3];
    const Vec3 n = cross(points[b] - points[a], points[c] - points[a]);
    const auto weight = [&](const Vec3& q, const Vec3& r)
    { return dot(cross(q - e.position, r - e.position), n) / squaredNorm(n); };
    e.position += share * (weight(points[b], points[c]) * way[a] + weight(points[c], points[a]) * way[b] +
                           weight(points[a], points[b]) * way[c]);
  };
  vtkSMPTools::For(0, vtkIdType(background.samples.size()),
                   [&](vtkIdType begin, vtkIdType end)
                   { std::for_each(background.samples.begin() + begin, background.samples.begin() + end, move); });
}

} // namespace

void smoothInterface(KuhnLattice& lattice, const Vec3& voxelSpacing, const SmoothingOptions& options)
{
  const InterfaceGraph graph = makeGraph(lattice);
  const std::vector<Vec3> target = taubin(graph, lattice.background.mesh.points, options.box * voxelSpacing, options);
  moveSamples(lattice.background, graph, target, options.samples);
  moveVertices(lattice.background.mesh, graph.vertices, target, options.minimumAngle);
}

void moveVertices(TetMesh& mesh, const std::vector<std::int32_t>& vertices, const std::vector<Vec3>& target,
                  double minimumAngle)
{
  // Moves are shortened until no tetrahedron is worse than allowed. All tetrahedra are tested in the same state, and a
  // vertex moves less if any of its tetrahedra is too bad, so the result does not depend on any order. Only tetrahedra
  // with a vertex that has moved are tested again.
  const std::vector<Vec3> home = mesh.points;
  constexpr std::array<float, 9> shares{ 1, 0.75f, 0.55f, 0.4f, 0.28f, 0.2f, 0.12f, 0.06f, 0 };
  const std::size_t n = vertices.size();
  std::vector<std::uint8_t> level(n, 0), moved(mesh.points.size(), 0);
  std::vector<std::atomic<bool>> tooFar(mesh.points.size());
  const auto moveAll = [&](auto&& isToMove)
  {
    std::atomic<bool> any{ false };
    vtkSMPTools::For(0, vtkIdType(n),
                     [&](vtkIdType begin, vtkIdType end)
                     {
                       for (vtkIdType i = begin; i < end; ++i)
                       {
                         const std::int32_t v = vertices[i];
                         moved[v] = isToMove(i);
                         tooFar[v] = false;
                         if (!moved[v]) continue;
                         mesh.points[v] = home[v] + double(shares[level[i]]) * (target[i] - home[v]);
                         any = true;
                       }
                     });
    return bool(any);
  };
  const auto isStillTooFar = [&](vtkIdType i)
  { return tooFar[vertices[i]] && level[i] + 1u < shares.size() && ++level[i] > 0; };
  const double floor = sine2OfDegrees(minimumAngle);
  for (bool any = moveAll([](vtkIdType) { return true; }); any; any = moveAll(isStillTooFar))
    vtkSMPTools::For(0, vtkIdType(mesh.tetrahedra.size()),
                     [&](vtkIdType begin, vtkIdType end)
                     {
                       for (vtkIdType t = begin; t < end; ++t)
                       {
                         const auto& x = mesh.tetrahedra[t];
                         if (!(moved[x[0]] | moved[x[1]] | moved[x[2]] | moved[x[3]])) continue;
                         const auto& p = mesh.points;
                         if (worstSine2(p[x[0]], p[x[1]], p[x[2]], p[x[3]]) >= floor) continue;
                         for (std::int32_t v : x) tooFar[v] = true;
                       }
                     });
}

} // namespace surgicalmesher
