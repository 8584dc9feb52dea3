// SPDX-License-Identifier: Apache-2.0
#include "SurfaceTetrahedralization.h"

#include "Compaction.h"

#include "FaceAdjacency.h"
#include "FlatTetrahedra.h"
#include "MeshChecks.h"
#include "SeparateProcess.h"

#include <tetgen.h>

#include <algorithm>

namespace surgicalmesher
{
namespace
{

using Triangle = std::array<std::int32_t, 3>;

Triangle ascending(Triangle t)
{
  std::sort(t.begin(), t.end());
  return t;
}

// ---- TetGen ---------------------------------------------------------------------------------------------------------

/// tetgenio frees its arrays with delete[].
double* ownedCoordinates(const std::vector<Vec3>& points)
{
  double* list = new double[3 * points.size()];
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis) list[3 * i + axis] = points[i][axis];
  }
  return list;
}

void fillFacets(tetgenio& input, const std::vector<Triangle>& triangles)
{
  input.numberoffacets = static_cast<int>(triangles.size());
  input.facetlist = new tetgenio::facet[triangles.size()];
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    tetgenio::facet& facet = input.facetlist[t];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    std::copy(triangles[t].begin(), triangles[t].end(), facet.polygonlist[0].vertexlist);
  }
}

std::string reasonOf(int code)
{
  switch (code)
  {
  case 1: return "out of memory";
  case 2: return "an internal error";
  case 3: return "it found triangles that cut each other";
  case 4: return "it found a detail too small for double precision";
  case 5: return "it found two triangles at too small an angle";
  default: return "code " + std::to_string(code);
  }
}

TetMesh meshOf(const tetgenio& output)
{
  TetMesh mesh;
  for (int i = 0; i < output.numberofpoints; ++i)
  {
    mesh.points.push_back({ output.pointlist[3 * i], output.pointlist[3 * i + 1], output.pointlist[3 * i + 2] });
  }
  double volume = 0;
  for (int t = 0; t < output.numberoftetrahedra; ++t)
  {
    const int* ids = output.tetrahedronlist + output.numberofcorners * t;
    mesh.tetrahedra.push_back({ ids[0], ids[1], ids[2], ids[3] });
    volume += orient(mesh.points[ids[0]], mesh.points[ids[1]], mesh.points[ids[2]], mesh.points[ids[3]]);
  }
  // TetGen orients all tetrahedra alike; the sign of a single, nearly flat one is unreliable.
  for (auto& tetrahedron : mesh.tetrahedra)
  {
    if (volume < 0) std::swap(tetrahedron[0], tetrahedron[1]);
  }
  return mesh;
}

// Result of the process that runs TetGen: its code (0: success), then the arrays.

template <class Item>
void append(std::string& bytes, const std::vector<Item>& items)
{
  const std::size_t count = items.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
  bytes.append(reinterpret_cast<const char*>(items.data()), count * sizeof(Item));
}

template <class Item>
std::size_t take(const std::string& bytes, std::size_t at, std::vector<Item>& items)
{
  std::size_t count = 0;
  bytes.copy(reinterpret_cast<char*>(&count), sizeof(count), at);
  items.resize(count);
  bytes.copy(reinterpret_cast<char*>(items.data()), count * sizeof(Item), at + sizeof(count));
  return at + sizeof(count) + count * sizeof(Item);
}

std::string runTetGen(const SurfaceComplex& surface, const std::vector<Vec3>& points)
{
  tetgenio input, output;
  std::vector<Vec3> all = surface.points;
  all.insert(all.end(), points.begin(), points.end());
  input.numberofpoints = static_cast<int>(all.size());
  input.pointlist = ownedCoordinates(all);
  fillFacets(input, surface.triangles);
  // p: piecewise linear complex, Y: no points added on it, c: convex hull kept, M: neither facets nor points merged, J:
  // numbering kept, B: no output of boundary faces, Q: quiet.
  std::string switches = "pYcMJBQ";
  try
  {
    ::tetrahedralize(switches.data(), &input, &output);
  }
  catch (const int code)
  {
    return std::string(1, static_cast<char>(code));
  }
  const TetMesh mesh = meshOf(output);
  std::string answer(1, '\0');
  append(answer, mesh.points);
  append(answer, mesh.tetrahedra);
  return answer;
}

/// Returns the tetrahedralized convex hull of all points, without labels.
TetMesh constrainedDelaunay(const SurfaceComplex& surface, const std::vector<Vec3>& points)
{
  const auto answer = runInSeparateProcess([&] { return runTetGen(surface, points); });
  if (!answer || answer->empty()) throw EngineError("constrained Delaunay: TetGen ended before it was done");
  const int code = static_cast<unsigned char>(answer->front());
  if (code != 0) throw EngineError("constrained Delaunay: TetGen gave up with " + reasonOf(code));
  TetMesh mesh;
  take(*answer, take(*answer, 1, mesh.points), mesh.tetrahedra);
  // Points that TetGen tried and abandoned are removed; those of the surface always keep their ids.
  mesh.points = valuesAt(mesh.points, compactPoints(mesh.tetrahedra, mesh.points.size(), surface.points.size()));
  return mesh;
}

// ---- labels ---------------------------------------------------------------------------------------------------------

/// Looks up triangles of the surface by their sorted points.
class TriangleIndex
{
public:
  explicit TriangleIndex(const std::vector<Triangle>& triangles)
  {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      m_Sorted.emplace_back(ascending(triangles[t]), static_cast<std::int32_t>(t));
    std::sort(m_Sorted.begin(), m_Sorted.end());
  }

  /// Returns -1 if these points form no triangle of the surface.
  std::int32_t find(const Triangle& points) const
  {
    const auto key = std::make_pair(ascending(points), std::int32_t(0));
    const auto found = std::lower_bound(m_Sorted.begin(), m_Sorted.end(), key);
    return found != m_Sorted.end() && found->first == key.first ? found->second : -1;
  }

private:
  std::vector<std::pair<Triangle, std::int32_t>> m_Sorted;
};

/// Returns for every face of every tetrahedron the surface triangle there, or -1.
std::vector<std::array<std::int32_t, 4>> trianglesAtFaces(const SurfaceComplex& surface, const TetMesh& mesh)
{
  const TriangleIndex index(surface.triangles);
  const auto surfacePoints = static_cast<std::int32_t>(surface.points.size());
  std::vector<std::array<std::int32_t, 4>> result(mesh.tetrahedra.size(), { -1, -1, -1, -1 });
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (int f = 0; f < 4; ++f)
    {
      Triangle points;
      for (int c = 0; c < 3; ++c) points[c] = mesh.tetrahedra[t][kFaceCorners[f][c]];
      if (*std::max_element(points.begin(), points.end()) < surfacePoints) result[t][f] = index.find(points);
    }
  }
  return result;
}

void requireEveryTriangle(const SurfaceComplex& surface, const std::vector<std::array<std::int32_t, 4>>& triangleAt)
{
  std::vector<bool> seen(surface.triangles.size(), false);
  for (const auto& faces : triangleAt)
  {
    for (const std::int32_t triangle : faces)
    {
      if (triangle >= 0) seen[triangle] = true;
    }
  }
  const auto missing = std::find(seen.begin(), seen.end(), false);
  if (missing == seen.end()) return;
  const auto& ids = surface.triangles[missing - seen.begin()];
  throw EngineError("constrained Delaunay: " + std::to_string(std::count(seen.begin(), seen.end(), false)) +
                    " triangles are missing from TetGen's mesh, the first at " + place(surface.points[ids[0]]));
}

/// Returns the label of the surface triangle on the side of a tetrahedron; `outward` is the tetrahedron's face, wound
/// outward.
Label labelInside(const SurfaceComplex& surface, std::int32_t triangle, const Triangle& outward)
{
  const Triangle& t = surface.triangles[triangle];
  const auto first = std::find(t.begin(), t.end(), outward[0]) - t.begin();
  const bool normalPointsOut = t[(first + 1) % 3] == outward[1];
  return surface.labels[triangle][normalPointsOut ? 0 : 1];
}

/// Returns one label per region between triangles, from the label pairs of all of them, and 0 at the hull.
std::vector<Label> regionLabels(const SurfaceComplex& surface, const TetMesh& mesh, const std::string& name)
{
  const FaceAdjacency neighbours = faceAdjacency(mesh);
  const auto triangleAt = trianglesAtFaces(surface, mesh);
  requireEveryTriangle(surface, triangleAt);
  const std::vector<std::int32_t> region =
    faceRegions(neighbours, [&](std::int32_t t, int f) { return triangleAt[t][f] < 0; });
  constexpr std::int32_t unknown = -1;
  std::vector<std::int32_t> label(1 + *std::max_element(region.begin(), region.end()), unknown);
  std::vector<std::int32_t> decidedBy(label.size(), -1);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (int f = 0; f < 4; ++f)
    {
      const std::int32_t triangle = triangleAt[t][f];
      if (triangle < 0 && neighbours.across[t][f] >= 0) continue;
      Triangle outward;
      for (int c = 0; c < 3; ++c) outward[c] = mesh.tetrahedra[t][kFaceCorners[f][c]];
      const std::int32_t wanted = triangle < 0 ? 0 : labelInside(surface, triangle, outward);
      std::int32_t& found = label[region[t]];
      if (found == unknown) found = wanted;
      else if (found != wanted)
      {
        throw SurfaceRefused(name + ": BoundaryLabels disagree about one region: " + std::to_string(found) + " and " +
                               std::to_string(wanted) + " at " + place(mesh.points[outward[0]]) +
                               ", expected one label on all sides of it",
                             surface, { std::max(triangle, std::max(0, decidedBy[region[t]])), std::max(0, triangle) });
      }
      if (triangle >= 0) decidedBy[region[t]] = triangle;
    }
  }
  std::vector<Label> result(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < result.size(); ++t) result[t] = static_cast<Label>(label[region[t]]);
  return result;
}

} // namespace

TetMesh tetrahedralize(const SurfaceComplex& surface, const std::vector<Vec3>& latticePoints, const std::string& name)
{
  if (surface.triangles.empty()) throw InputError(name + ": no triangles");
  TetMesh mesh = constrainedDelaunay(surface, latticePoints);
  if (mesh.tetrahedra.empty()) throw EngineError("constrained Delaunay: TetGen returned no tetrahedra");
  mesh.labels = regionLabels(surface, mesh, name);
  liftFlatTetrahedra(mesh);
  return mesh;
}

TetMesh fillWithTetrahedra(const SurfaceComplex& surface, const SizingFunction& edgeLength, const std::string& name,
                           VertexPlacement placement)
{
  const auto filled = [&](double clearance)
  {
    const std::vector<Vec3> lattice = latticePoints(surface, edgeLength, clearance);
    return tetrahedralize(surface, placedPoints(surface, lattice, edgeLength, placement, clearance), name);
  };
  for (const double clearance : { 0.4, 0.6 })
  {
    try
    {
      return filled(clearance);
    }
    catch (const EngineError&)
    {
      // The next clearance gives other points, free of this coincidence.
    }
  }
  return filled(0.75);
}

} // namespace surgicalmesher
