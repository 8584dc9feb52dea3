#include "FaceNeighbours.h"

#include <algorithm>

namespace surgicalmesher
{
namespace
{

struct Face
{
  std::array<std::int32_t, 3> points; ///< ascending
  std::int32_t tetrahedron;
  std::int32_t local;
};

/// Ascending, those of the same points in the order of their tetrahedra. Sorted into the places of their first points by
/// counting, and there by their other two: some twenty at a place.
std::vector<Face> sortedFaces(const TetraMesh& mesh)
{
  const auto face = [&](std::size_t t, int f)
  {
    Face result{ {}, static_cast<std::int32_t>(t), f };
    for (int c = 0; c < 3; ++c) result.points[c] = mesh.tetrahedra[t][kFaceCorners[f][c]];
    std::sort(result.points.begin(), result.points.end());
    return result;
  };
  std::vector<std::size_t> end(mesh.points.size() + 1, 0);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (int f = 0; f < 4; ++f) ++end[face(t, f).points[0] + 1];
  for (std::size_t v = 0; v < mesh.points.size(); ++v) end[v + 1] += end[v];
  std::vector<Face> faces(4 * mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (int f = 0; f < 4; ++f)
    {
      const Face next = face(t, f);
      faces[end[next.points[0]]++] = next;
    }
  const auto before = [](const Face& a, const Face& b)
  {
    if (a.points[1] != b.points[1]) return a.points[1] < b.points[1];
    if (a.points[2] != b.points[2]) return a.points[2] < b.points[2];
    return a.tetrahedron != b.tetrahedron ? a.tetrahedron < b.tetrahedron : a.local < b.local;
  };
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    std::sort(faces.begin() + std::ptrdiff_t(v ? end[v - 1] : 0), faces.begin() + std::ptrdiff_t(end[v]), before);
  return faces;
}

} // namespace

FaceNeighbours faceNeighbours(const TetraMesh& mesh)
{
  FaceNeighbours result;
  result.across.assign(mesh.tetrahedra.size(), { -1, -1, -1, -1 });
  const std::vector<Face> faces = sortedFaces(mesh);
  for (std::size_t begin = 0, end; begin < faces.size(); begin = end)
  {
    for (end = begin + 1; end < faces.size() && faces[end].points == faces[begin].points;) ++end;
    if (end - begin == 2)
    {
      result.across[faces[begin].tetrahedron][faces[begin].local] = faces[begin + 1].tetrahedron;
      result.across[faces[begin + 1].tetrahedron][faces[begin + 1].local] = faces[begin].tetrahedron;
    }
    for (std::size_t i = begin; end - begin > 2 && i < end; ++i) result.overused.push_back(faces[i].tetrahedron);
  }
  std::sort(result.overused.begin(), result.overused.end());
  result.overused.erase(std::unique(result.overused.begin(), result.overused.end()), result.overused.end());
  return result;
}

std::vector<std::int32_t> faceRegions(const FaceNeighbours& neighbours,
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

SurfaceComplex interfaceOf(const TetraMesh& mesh, std::vector<std::int32_t>* pointIds)
{
  const FaceNeighbours neighbours = faceNeighbours(mesh);
  SurfaceComplex surface;
  std::vector<std::int32_t> surfaceId(mesh.points.size(), -1);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (int f = 0; f < 4; ++f)
    {
      const std::int32_t beyond = neighbours.across[t][f];
      const Label front = beyond < 0 ? Label(0) : mesh.labels[beyond];
      if (mesh.labels[t] <= front) continue;
      std::array<std::int32_t, 3> triangle;
      for (int c = 0; c < 3; ++c) triangle[c] = mesh.tetrahedra[t][kFaceCorners[f][c]];
      for (const std::int32_t id : triangle) surfaceId[id] = 0;
      surface.triangles.push_back(triangle);
      surface.labels.push_back({ mesh.labels[t], front });
    }
  }
  if (pointIds) pointIds->clear();
  for (std::size_t i = 0; i < surfaceId.size(); ++i)
  {
    if (surfaceId[i] < 0) continue;
    surfaceId[i] = static_cast<std::int32_t>(surface.points.size());
    surface.points.push_back(mesh.points[i]);
    if (pointIds) pointIds->push_back(static_cast<std::int32_t>(i));
  }
  for (auto& triangle : surface.triangles)
  {
    for (std::int32_t& id : triangle) id = surfaceId[id];
  }
  return surface;
}

TetraMesh withoutOutside(const TetraMesh& mesh, std::vector<std::int32_t>* pointIds)
{
  TetraMesh result;
  std::vector<std::int32_t> newId(mesh.points.size(), -1);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    if (mesh.labels[t] == 0) continue;
    for (const std::int32_t id : mesh.tetrahedra[t]) newId[id] = 0;
    result.tetrahedra.push_back(mesh.tetrahedra[t]);
    result.labels.push_back(mesh.labels[t]);
  }
  if (pointIds) pointIds->clear();
  for (std::size_t i = 0; i < newId.size(); ++i)
  {
    if (newId[i] < 0) continue;
    newId[i] = static_cast<std::int32_t>(result.points.size());
    result.points.push_back(mesh.points[i]);
    if (pointIds) pointIds->push_back(static_cast<std::int32_t>(i));
  }
  for (auto& tetrahedron : result.tetrahedra)
  {
    for (std::int32_t& id : tetrahedron) id = newId[id];
  }
  return result;
}

} // namespace surgicalmesher
