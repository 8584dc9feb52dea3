// SPDX-License-Identifier: Apache-2.0
#include "SimplexMesh.h"

#include "Errors.h"
#include "MeshChecks.h"

#include <algorithm>
#include <tuple>

namespace surgicalmesher
{

namespace
{

struct TriangleEdge
{
  std::int32_t low, high; ///< point ids
  std::int32_t triangle;
  int corner; ///< opposite the edge
};

std::vector<TriangleEdge> edgesOf(const SurfaceComplex& surface)
{
  std::vector<TriangleEdge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const auto [low, high] = std::minmax(surface.triangles[t][(k + 1) % 3], surface.triangles[t][(k + 2) % 3]);
      edges.push_back({ low, high, std::int32_t(t), k });
    }
  std::sort(edges.begin(), edges.end(),
            [](const TriangleEdge& a, const TriangleEdge& b)
            { return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle); });
  return edges;
}

bool touches(const std::array<Label, 2>& labels, Label tissue) { return labels[0] == tissue || labels[1] == tissue; }

int sideOf(const std::array<Label, 2>& labels, Label tissue) { return labels[0] == tissue ? 0 : 1; }

/// Makes the two triangles that each tissue's surface has at one edge neighbours of each other.
void joinAtEdge(const SurfaceComplex& surface, const TriangleEdge* begin, const TriangleEdge* end, Extent extent,
                SimplexMesh& mesh)
{
  for (const TriangleEdge* e = begin; e != end; ++e)
    for (int side = 0; side < 2; ++side)
    {
      const Label tissue = mesh.labels[e->triangle][side];
      const TriangleEdge* other = nullptr;
      int others = 0;
      for (const TriangleEdge* f = begin; f != end; ++f)
        if (f != e && touches(mesh.labels[f->triangle], tissue)) other = f, ++others;
      if (others == 1) mesh.neighbours[e->triangle][side][e->corner] = other->triangle;
      else if (tissue != 0 && (others > 1 || extent == Extent::whole))
        throw InputError("simplex mesh: tissue " + std::to_string(tissue) + " has " + std::to_string(others + 1) +
                         " triangles at the edge at " +
                         place(0.5 * (surface.points[e->low] + surface.points[e->high])) + ", expected 2");
    }
}

/// Normal equations of the fit: dual points are the unknowns, vertices the observed centroids; a small weight on the
/// start regularizes.
struct CentroidFit
{
  static constexpr double stay = 0.02; ///< weight of the start, which decides where the centroids leave a choice
  const SimplexMesh& mesh;
  std::vector<double> count; ///< vertices around each point

  std::vector<Vec3> transposed(const std::vector<Vec3>& perVertex) const
  {
    std::vector<Vec3> sum(count.size());
    for (std::size_t v = 0; v < perVertex.size(); ++v)
      for (std::int32_t f : mesh.faces[v]) sum[f] += perVertex[v] / 3;
    return sum;
  }

  std::vector<Vec3> centroids(const std::vector<Vec3>& x) const
  {
    std::vector<Vec3> c(mesh.points.size());
    for (std::size_t v = 0; v < c.size(); ++v)
      for (std::int32_t f : mesh.faces[v]) c[v] += x[f] / 3;
    return c;
  }

  std::vector<Vec3> applied(const std::vector<Vec3>& x) const
  {
    std::vector<Vec3> y = transposed(centroids(x));
    for (std::size_t f = 0; f < y.size(); ++f) y[f] += stay * count[f] / 9 * x[f];
    return y;
  }
};

double product(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

/// Minimizes the squared distances between centroids and vertices by conjugate gradients, starting from `x`.
void fitCentroids(const CentroidFit& fit, std::vector<Vec3>& x)
{
  constexpr int iterations = 60;
  std::vector<Vec3> miss = fit.centroids(x);
  for (std::size_t v = 0; v < miss.size(); ++v) miss[v] = fit.mesh.points[v] - miss[v];
  std::vector<Vec3> residual = fit.transposed(miss), direction = residual;
  double size = product(residual, residual);
  const double enough = 1e-16 * size;
  for (int n = 0; n < iterations && size > enough; ++n)
  {
    const std::vector<Vec3> image = fit.applied(direction);
    const double step = size / product(direction, image);
    for (std::size_t f = 0; f < x.size(); ++f)
    {
      x[f] += step * direction[f];
      residual[f] -= step * image[f];
    }
    const double next = product(residual, residual);
    for (std::size_t f = 0; f < x.size(); ++f) direction[f] = residual[f] + next / size * direction[f];
    size = next;
  }
}

/// Returns the vertices around face `mesh.faces[start][corner]` on the surface of the tissue on one side of `start`.
std::vector<std::int32_t> walkAround(const SimplexMesh& mesh, std::int32_t start, int side, int corner)
{
  const std::int32_t face = mesh.faces[start][corner];
  const Label tissue = mesh.labels[start][side];
  std::vector<std::int32_t> around;
  for (std::int32_t v = start; v >= 0 && (around.empty() || v != start);)
  {
    around.push_back(v);
    const int c = int(std::find(mesh.faces[v].begin(), mesh.faces[v].end(), face) - mesh.faces[v].begin());
    const int s = sideOf(mesh.labels[v], tissue);
    v = mesh.neighbours[v][s][(c + (s == 0 ? 1 : 2)) % 3];
  }
  return around;
}

} // namespace

SimplexMesh simplexMeshOf(const SurfaceComplex& surface, Extent extent)
{
  SimplexMesh mesh;
  const auto& p = surface.points;
  for (const auto& [a, b, c] : surface.triangles) mesh.points.push_back((p[a] + p[b] + p[c]) / 3);
  mesh.labels = surface.labels;
  mesh.faces = surface.triangles;
  mesh.faceCount = std::int32_t(p.size());
  constexpr std::array<std::int32_t, 3> none{ -1, -1, -1 };
  mesh.neighbours.assign(surface.triangles.size(), { none, none });
  const std::vector<TriangleEdge> edges = edgesOf(surface);
  for (std::size_t begin = 0, end; begin < edges.size(); begin = end)
  {
    for (end = begin + 1;
         end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high;)
      ++end;
    joinAtEdge(surface, &edges[begin], &edges[begin] + (end - begin), extent, mesh);
  }
  for (auto& sides : mesh.neighbours)
    for (auto& three : sides)
      if (std::count(three.begin(), three.end(), -1) > 0) three = none;
  return mesh;
}

SurfaceComplex dualTriangles(const SimplexMesh& mesh)
{
  SurfaceComplex surface;
  surface.triangles = mesh.faces;
  surface.labels = mesh.labels;
  surface.points.resize(mesh.faceCount);
  CentroidFit fit{ mesh, std::vector<double>(mesh.faceCount, 0) };
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (std::int32_t f : mesh.faces[v])
    {
      surface.points[f] += mesh.points[v];
      ++fit.count[f];
    }
  for (std::size_t f = 0; f < fit.count.size(); ++f) surface.points[f] = surface.points[f] / std::max(1., fit.count[f]);
  fitCentroids(fit, surface.points);
  return surface;
}

std::vector<SimplexFace> simplexFaces(const SimplexMesh& mesh)
{
  std::vector<SimplexFace> faces;
  std::vector<std::array<std::array<bool, 3>, 2>> seen(mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (int side = 0; side < 2; ++side)
      for (int c = 0; c < 3; ++c)
      {
        const Label tissue = mesh.labels[v][side];
        if (tissue == 0 || seen[v][side][c]) continue;
        SimplexFace face{ tissue, mesh.faces[v][c], walkAround(mesh, std::int32_t(v), side, c) };
        for (std::int32_t w : face.vertices)
        {
          const auto& around = mesh.faces[w];
          seen[w][sideOf(mesh.labels[w], tissue)][std::find(around.begin(), around.end(), face.id) - around.begin()] =
            true;
        }
        faces.push_back(std::move(face));
      }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const SimplexFace& a, const SimplexFace& b)
                   { return std::tie(a.id, a.tissue) < std::tie(b.id, b.tissue); });
  return faces;
}

} // namespace surgicalmesher
