// SPDX-License-Identifier: Apache-2.0
#include "FaceAdjacency.h"

#include "Compaction.h"
#include "Grouped.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <mutex>

namespace surgicalmesher
{
namespace
{

/// A face without its smallest point, by which faces are grouped.
struct Face
{
  std::uint64_t others; ///< its two larger points, the middle one in the upper half
  std::int32_t tetrahedron;
  std::int32_t local;
};

/// The points of the face opposite corner f, ascending.
std::array<std::int32_t, 3> sortedFace(const std::array<std::int32_t, 4>& t, int f)
{
  std::array<std::int32_t, 3> p{ t[kFaceCorners[f][0]], t[kFaceCorners[f][1]], t[kFaceCorners[f][2]] };
  if (p[0] > p[1]) std::swap(p[0], p[1]);
  if (p[1] > p[2]) std::swap(p[1], p[2]);
  if (p[0] > p[1]) std::swap(p[0], p[1]);
  return p;
}

bool operator<(const Face& a, const Face& b)
{
  if (a.others != b.others) return a.others < b.others;
  return a.tetrahedron != b.tetrahedron ? a.tetrahedron < b.tetrahedron : a.local < b.local;
}

/// Pairs equal faces among those from `begin` to `end`, which have the same smallest point.
void pairFaces(Face* begin, Face* end, AcrossFaces& across, std::vector<std::int32_t>& overused)
{
  std::sort(begin, end);
  for (Face* next; begin != end; begin = next)
  {
    for (next = begin + 1; next != end && next->others == begin->others;) ++next;
    if (next - begin == 2)
    {
      across[begin[0].tetrahedron][begin[0].local] = begin[1].tetrahedron;
      across[begin[1].tetrahedron][begin[1].local] = begin[0].tetrahedron;
    }
    for (const Face* face = begin; next - begin > 2 && face != next; ++face) overused.push_back(face->tetrahedron);
  }
}

} // namespace

FaceAdjacency faceAdjacency(const TetMesh& mesh)
{
  FaceAdjacency result;
  result.across.assign(mesh.tetrahedra.size(), { -1, -1, -1, -1 });
  result.overused = matchOpenFaces(mesh.tetrahedra, mesh.points.size(), result.across);
  return result;
}

std::vector<std::int32_t> matchOpenFaces(const std::vector<std::array<std::int32_t, 4>>& tetrahedra,
                                         std::size_t pointCount, AcrossFaces& across)
{
  // Faces are grouped by their smallest points: some twenty per point are left to compare.
  const auto forEachOpen = [&](std::size_t begin, std::size_t end, auto&& visit)
  {
    for (std::size_t t = begin; t < end; ++t)
      for (int local = 0; local < 4; ++local)
      {
        if (across[t][local] >= 0) continue;
        const std::array<std::int32_t, 3> p = sortedFace(tetrahedra[t], local);
        visit(std::size_t(p[0]), Face{ std::uint64_t(p[1]) << 32 | std::uint32_t(p[2]), std::int32_t(t), local });
      }
  };
  Grouped<Face> faces(pointCount, across.size(), forEachOpen);
  std::vector<std::int32_t> overused;
  std::mutex mutex;
  vtkSMPTools::For(0, vtkIdType(pointCount),
                   [&](vtkIdType first, vtkIdType last)
                   {
                     std::vector<std::int32_t> here;
                     for (vtkIdType v = first; v < last; ++v)
                       pairFaces(faces.begin(std::size_t(v)), faces.end(std::size_t(v)), across, here);
                     const std::lock_guard<std::mutex> lock(mutex);
                     overused.insert(overused.end(), here.begin(), here.end());
                   });
  std::sort(overused.begin(), overused.end());
  overused.erase(std::unique(overused.begin(), overused.end()), overused.end());
  return overused;
}

std::vector<std::int32_t> faceRegions(const FaceAdjacency& neighbours,
                                      const std::function<bool(std::int32_t t, int f)>& joined)
{
  std::vector<std::int32_t> region(neighbours.across.size(), -1);
  std::vector<std::int32_t> front;
  std::int32_t count = 0;
  for (std::size_t seed = 0; seed < region.size(); ++seed)
  {
    if (region[seed] >= 0) continue;
    region[seed] = count;
    front.assign(1, static_cast<std::int32_t>(seed));
    while (!front.empty())
    {
      const std::int32_t t = front.back();
      front.pop_back();
      for (int f = 0; f < 4; ++f)
      {
        const std::int32_t next = neighbours.across[t][f];
        if (next < 0 || region[next] >= 0 || !joined(t, f)) continue;
        region[next] = count;
        front.push_back(next);
      }
    }
    ++count;
  }
  return region;
}

std::vector<InterfaceFace> interfaceFaces(const TetMesh& mesh)
{
  return interfaceFaces(mesh, faceAdjacency(mesh).across);
}

std::vector<InterfaceFace> interfaceFaces(const TetMesh& mesh, const AcrossFaces& across)
{
  std::vector<InterfaceFace> faces;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (int f = 0; f < 4; ++f)
    {
      const std::int32_t beyond = across[t][f];
      const Label front = beyond < 0 ? Label(0) : mesh.labels[beyond];
      if (mesh.labels[t] > front) faces.push_back({ std::int32_t(t), f, front });
    }
  return faces;
}

SurfaceComplex interfaceOf(const TetMesh& mesh, std::vector<std::int32_t>* pointIds)
{
  return interfaceOf(mesh, faceAdjacency(mesh).across, pointIds);
}

SurfaceComplex interfaceOf(const TetMesh& mesh, const AcrossFaces& across, std::vector<std::int32_t>* pointIds)
{
  SurfaceComplex surface;
  for (const auto& [t, f, front] : interfaceFaces(mesh, across))
  {
    std::array<std::int32_t, 3> triangle;
    for (int c = 0; c < 3; ++c) triangle[c] = mesh.tetrahedra[t][kFaceCorners[f][c]];
    surface.triangles.push_back(triangle);
    surface.labels.push_back({ mesh.labels[t], front });
  }
  std::vector<std::int32_t> ids = compactPoints(surface.triangles, mesh.points.size());
  surface.points = valuesAt(mesh.points, ids);
  if (pointIds) *pointIds = std::move(ids);
  return surface;
}

TetMesh withoutOutside(const TetMesh& mesh, std::vector<std::int32_t>* pointIds)
{
  TetMesh result;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    if (mesh.labels[t] == 0) continue;
    result.tetrahedra.push_back(mesh.tetrahedra[t]);
    result.labels.push_back(mesh.labels[t]);
  }
  std::vector<std::int32_t> ids = compactPoints(result.tetrahedra, mesh.points.size());
  result.points = valuesAt(mesh.points, ids);
  if (pointIds) *pointIds = std::move(ids);
  return result;
}

} // namespace surgicalmesher
