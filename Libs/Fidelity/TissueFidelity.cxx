// SPDX-License-Identifier: Apache-2.0
#include "TissueFidelity.h"

#include "BoundaryDistance.h"
#include "BoundaryFaces.h"
#include "Grouped.h"
#include "Parallel.h"
#include "Triangle.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surgicalmesher
{

namespace
{

using Voxel = std::array<int, 3>;

void add(Distances& all, double distance, const Vec3& place, double bound)
{
  ++all.samples;
  all.beyond += distance > bound;
  all.mean += distance; // a sum until finish()
  if (distance <= all.maximum) return;
  all.maximum = distance;
  all.farthest = place;
}

void add(Distances& all, const Distances& more)
{
  all.samples += more.samples;
  all.beyond += more.beyond;
  all.mean += more.mean;
  if (more.maximum <= all.maximum) return;
  all.maximum = more.maximum;
  all.farthest = more.farthest;
}

void finish(Distances& all) { all.mean = all.samples ? all.mean / double(all.samples) : 0; }

/// Distances by tissue, with separate sums for each part of the work, so that any thread can add to a part.
class Sums
{
public:
  Sums(const std::vector<Label>& labels, std::size_t parts) : m_Labels(labels), m_IndexOf(labelCount, -1)
  {
    for (std::size_t n = 0; n < labels.size(); ++n) m_IndexOf[labels[n]] = int(n);
    m_Sums.resize(parts, std::vector<Distances>(labels.size()));
  }

  bool has(Label label) const { return m_IndexOf[label] >= 0; }
  Distances& of(std::size_t part, Label label) { return m_Sums[part][m_IndexOf[label]]; }

  void store(std::map<Label, TissueFidelity>& tissues, Distances TissueFidelity::*side) const
  {
    for (std::size_t n = 0; n < m_Labels.size(); ++n)
    {
      Distances& all = tissues[m_Labels[n]].*side;
      for (const std::vector<Distances>& part : m_Sums) add(all, part[n]);
      finish(all);
    }
  }

private:
  const std::vector<Label>& m_Labels;
  std::vector<int> m_IndexOf;
  std::vector<std::vector<Distances>> m_Sums;
};

/// The triangles, listed in the cells of a regular grid that their bounding boxes touch.
class TriangleGrid
{
  static constexpr double infinity = std::numeric_limits<double>::infinity();

public:
  explicit TriangleGrid(const SurfaceComplex& surface) : m_Surface(surface)
  {
    if (surface.triangles.empty()) return;
    Vec3 low = surface.points[surface.triangles[0][0]], high = low;
    double extent = 0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      const auto [from, to] = box(t);
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], from[axis]);
        high[axis] = std::max(high[axis], to[axis]);
      }
      extent += norm(to - from);
    }
    m_Origin = low;
    constexpr double ofBox = 0.5; // smaller cells hold fewer triangles each, but triangles are in more cells
    m_Size = std::max(ofBox * extent / double(surface.triangles.size()), 1e-9);
    const auto cells = [&]
    {
      return std::ceil((high.x - low.x) / m_Size + 1) * std::ceil((high.y - low.y) / m_Size + 1) *
             std::ceil((high.z - low.z) / m_Size + 1);
    };
    while (cells() > 3e7) m_Size *= 1.5;
    for (int axis = 0; axis < 3; ++axis) m_Cells[axis] = int(std::floor((high[axis] - low[axis]) / m_Size)) + 1;
    m_Triangles = Grouped<std::int32_t>(std::size_t(m_Cells[0]) * m_Cells[1] * m_Cells[2],
                                        [&](auto&& visit)
                                        {
                                          for (std::size_t t = 0; t < surface.triangles.size(); ++t)
                                            forCells(t, [&](std::size_t c) { visit(c, std::int32_t(t)); });
                                        });
    for (const auto& [a, b, c] : surface.triangles)
    {
      const Vec3 centre = (surface.points[a] + surface.points[b] + surface.points[c]) / 3;
      const double radius2 =
        std::max({ squaredNorm(surface.points[a] - centre), squaredNorm(surface.points[b] - centre),
                   squaredNorm(surface.points[c] - centre) });
      m_Spheres.push_back({ centre, std::sqrt(radius2) });
    }
  }

  /// Squared distances from p to the nearest triangle of each of two tissues; infinite for one without triangles.
  std::array<double, 2> squaredDistances(const Vec3& p, const std::array<Label, 2>& tissues) const
  {
    Search search{ p, tissues };
    if (m_Surface.triangles.empty()) return search.best;
    const Voxel seen = findAny(search);
    if (search.reach() == infinity) return search.best;
    visitAround(p, search.reach(),
                [&](int i, int j, int k)
                {
                  if (Voxel{ i, j, k } != seen) look(search, i, j, k);
                });
    return search.best;
  }

private:
  std::pair<Vec3, Vec3> box(std::size_t t) const
  {
    const auto& [a, b, c] = m_Surface.triangles[t];
    Vec3 low = m_Surface.points[a], high = low;
    for (const std::int32_t point : { b, c })
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], m_Surface.points[point][axis]);
        high[axis] = std::max(high[axis], m_Surface.points[point][axis]);
      }
    }
    return { low, high };
  }

  std::size_t cell(int i, int j, int k) const { return (std::size_t(k) * m_Cells[1] + j) * m_Cells[0] + i; }

  template <class Visit>
  void forCells(std::size_t t, const Visit& visit) const
  {
    const auto [low, high] = box(t);
    Voxel from, to;
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = std::clamp(int((low[axis] - m_Origin[axis]) / m_Size), 0, m_Cells[axis] - 1);
      to[axis] = std::clamp(int((high[axis] - m_Origin[axis]) / m_Size), 0, m_Cells[axis] - 1);
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) visit(cell(i, j, k));
  }

  /// A lower bound on the squared distance, safe against rounding.
  double squaredDistanceToCell(const Vec3& p, const Voxel& at) const
  {
    const double rounding = 1e-9 * m_Size;
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double low = m_Origin[axis] + at[axis] * m_Size;
      const double beyond = std::max({ low - p[axis], p[axis] - (low + m_Size), rounding }) - rounding;
      sum += beyond * beyond;
    }
    return sum;
  }

  template <class Visit>
  void visitRing(const Voxel& centre, int ring, const Visit& visit) const
  {
    const auto range = [&](int axis)
    { return std::pair(std::max(centre[axis] - ring, 0), std::min(centre[axis] + ring, m_Cells[axis] - 1)); };
    for (int k = range(2).first; k <= range(2).second; ++k)
    {
      for (int j = range(1).first; j <= range(1).second; ++j)
      {
        const bool isShell = std::abs(k - centre[2]) == ring || std::abs(j - centre[1]) == ring;
        for (int i = range(0).first; i <= range(0).second; ++i)
        {
          if (!isShell && std::abs(i - centre[0]) != ring)
          {
            i = std::max(i, centre[0] + ring - 1);
            continue;
          }
          visit(i, j, k);
        }
      }
    }
  }

  /// The state of a search for the triangles nearest to p.
  struct Search
  {
    const Vec3& p;
    const std::array<Label, 2>& tissues;
    std::array<double, 2> best{ infinity, infinity };     ///< squared distances
    std::array<double, 2> distance{ infinity, infinity }; ///< their roots

    /// The distance beyond which no triangle can improve the result.
    double reach() const { return std::max(tissues[0] ? distance[0] : 0, tissues[1] ? distance[1] : 0); }
  };

  /// Searches the cells ring by ring until a triangle of each tissue is found or no cell is left. Returns a cell that
  /// was searched.
  Voxel findAny(Search& search) const
  {
    Voxel centre;
    for (int axis = 0; axis < 3; ++axis)
      centre[axis] = std::clamp(int(std::floor((search.p[axis] - m_Origin[axis]) / m_Size)), -1, m_Cells[axis]);
    const int rings = std::max({ m_Cells[0], m_Cells[1], m_Cells[2] }) + 1;
    for (int ring = 0; ring <= rings && search.reach() == infinity; ++ring)
      visitRing(centre, ring, [&](int i, int j, int k) { look(search, i, j, k); });
    return centre;
  }

  void look(Search& search, int i, int j, int k) const
  {
    const double reach = search.reach();
    if (squaredDistanceToCell(search.p, { i, j, k }) > reach * reach) return;
    const std::size_t at = cell(i, j, k);
    for (const std::int32_t* t = m_Triangles.begin(at); t != m_Triangles.end(at); ++t) improve(search, *t);
  }

  /// Calls visit(i, j, k) for the cells that the box of half-width `reach` around p touches.
  template <class Visit>
  void visitAround(const Vec3& p, double reach, const Visit& visit) const
  {
    const double rounding = 1e-9 * m_Size;
    Voxel from, to;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto cellAt = [&](double place)
      { return int(std::floor(std::clamp(place / m_Size, -1.0, double(m_Cells[axis])))); };
      from[axis] = std::max(cellAt(p[axis] - m_Origin[axis] - reach - rounding), 0);
      to[axis] = std::min(cellAt(p[axis] - m_Origin[axis] + reach + rounding), m_Cells[axis] - 1);
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) visit(i, j, k);
  }

  void improve(Search& search, std::int32_t t) const
  {
    const std::array<Label, 2>& labels = m_Surface.labels[t];
    const auto bounds = [&](Label tissue) { return tissue != 0 && (labels[0] == tissue || labels[1] == tissue); };
    const std::array<bool, 2> isBound{ bounds(search.tissues[0]), bounds(search.tissues[1]) };
    if (!isBound[0] && !isBound[1]) return;
    const auto& [centre, radius] = m_Spheres[t];
    const double farthest = // distance of a centre whose triangle can still be nearer
      radius + std::max(isBound[0] ? search.distance[0] : 0, isBound[1] ? search.distance[1] : 0);
    if (squaredNorm(search.p - centre) > farthest * farthest) return;
    const auto& [a, b, c] = m_Surface.triangles[t];
    const double d = squaredDistanceToTriangle(search.p, m_Surface.points[a], m_Surface.points[b], m_Surface.points[c]);
    for (int side = 0; side < 2; ++side)
      if (isBound[side] && d < search.best[side]) search.best[side] = d, search.distance[side] = std::sqrt(d);
  }

  const SurfaceComplex& m_Surface;
  Vec3 m_Origin;
  double m_Size = 1;
  Voxel m_Cells{ 0, 0, 0 };
  Grouped<std::int32_t> m_Triangles; ///< by cell
  struct Sphere
  {
    Vec3 centre;
    double radius;
  };
  std::vector<Sphere> m_Spheres; ///< around the triangles, by which most are rejected without the full distance
};

/// `sums` has one part for each slice of forEachBoundaryFace().
void measureFromMap(const SurfaceComplex& surface, const TissueMap& map, double bound, Sums& sums)
{
  const TriangleGrid grid(surface);
  parallelForEach(std::size_t(map.grid.size[2]) + 1,
                  [&](std::size_t part)
                  {
                    const auto measure = [&](const VoxelFace& face)
                    {
                      const std::array<Label, 2> labels{ labelAt(map, face.lower), labelAt(map, face.upper()) };
                      const Vec3 p = face.centre(map.grid.spacing);
                      const std::array<double, 2> squared = grid.squaredDistances(p, labels);
                      for (int side = 0; side < 2; ++side)
                        if (labels[side] != 0) add(sums.of(part, labels[side]), std::sqrt(squared[side]), p, bound);
                    };
                    forEachBoundaryFace(map, int(part) - 1, measure);
                  });
}

/// Distance from p to the nearest voxel face around the tissue in the map, limited to eight times the smallest spacing.
double distanceToFaces(const TissueMap& map, const Vec3& p, Label tissue)
{
  constexpr int mostReach = 8;
  const Vec3& spacing = map.grid.spacing;
  const double least = std::min({ spacing.x, spacing.y, spacing.z });
  Voxel centre;
  for (int a = 0; a < 3; ++a) centre[a] = int(std::lround(p[a] / spacing[a]));
  double best = mostReach * least * mostReach * least;
  for (int reach = 0; reach <= mostReach; ++reach)
  {
    const double nearest = (reach - 1) * least; // lower bound for the faces of this shell
    if (reach > 0 && best <= nearest * nearest) break;
    for (int k = -reach; k <= reach; ++k)
    {
      for (int j = -reach; j <= reach; ++j)
      {
        const bool isInside = std::max(std::abs(j), std::abs(k)) < reach;
        for (int i = -reach; i <= reach; i += isInside ? 2 * reach : 1)
        {
          const Voxel voxel{ centre[0] + i, centre[1] + j, centre[2] + k };
          const bool isTissue = labelAt(map, voxel) == tissue;
          for (int axis = 0; axis < 3; ++axis)
          {
            Voxel next = voxel;
            ++next[axis];
            if ((labelAt(map, next) == tissue) != isTissue)
              best = std::min(best, squaredDistanceToFace(p, voxel, axis, spacing));
          }
        }
      }
    }
  }
  return std::sqrt(best);
}

/// A sample of a tissue's surface: a vertex, once for each tissue that it bounds, or the centroid of a triangle.
struct SurfaceSample
{
  Vec3 place;
  Label tissue;
};

std::vector<SurfaceSample> samplesOf(const SurfaceComplex& surface)
{
  std::vector<std::pair<std::int32_t, Label>> corners;
  std::vector<SurfaceSample> samples;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 centroid = (surface.points[a] + surface.points[b] + surface.points[c]) / 3;
    for (const Label label : surface.labels[t])
    {
      if (label == 0) continue;
      samples.push_back({ centroid, label });
      for (const std::int32_t point : { a, b, c }) corners.emplace_back(point, label);
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const auto& [point, label] : corners) samples.push_back({ surface.points[point], label });
  return samples;
}

void measureFromMesh(const SurfaceComplex& surface, const TissueMap& map, double bound, std::size_t parts, Sums& sums)
{
  const std::vector<SurfaceSample> samples = samplesOf(surface);
  vtkSMPTools::For(0, vtkIdType(parts),
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (std::size_t part = std::size_t(begin); part < std::size_t(end); ++part)
                     {
                       for (std::size_t n = part * samples.size() / parts; n < (part + 1) * samples.size() / parts; ++n)
                       {
                         const auto& [place, tissue] = samples[n];
                         if (sums.has(tissue))
                           add(sums.of(part, tissue), distanceToFaces(map, place, tissue), place, bound);
                       }
                     }
                   });
}

} // namespace

std::map<Label, TissueFidelity> assessFidelity(const SurfaceComplex& surface, const TissueMap& map, double bound)
{
  const std::vector<Label> labels = presentLabels(map);
  std::map<Label, TissueFidelity> tissues;
  const double voxel = map.grid.spacing.x * map.grid.spacing.y * map.grid.spacing.z;
  for (const auto& [label, voxels] : countVoxels(map))
  {
    if (label != 0) tissues[label].mapVolume = double(voxels) * voxel;
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const double part = dot(surface.points[a], cross(surface.points[b], surface.points[c])) / 6;
    const auto behind = tissues.find(surface.labels[t][0]), front = tissues.find(surface.labels[t][1]);
    if (behind != tissues.end()) behind->second.meshVolume += part;
    if (front != tissues.end()) front->second.meshVolume -= part;
  }
  Sums fromMap(labels, std::size_t(map.grid.size[2]) + 1);
  measureFromMap(surface, map, bound, fromMap);
  fromMap.store(tissues, &TissueFidelity::mapToMesh);
  constexpr std::size_t parts = 64;
  Sums fromMesh(labels, parts);
  measureFromMesh(surface, map, bound, parts, fromMesh);
  fromMesh.store(tissues, &TissueFidelity::meshToMap);
  return tissues;
}

Distances allDistances(const std::map<Label, TissueFidelity>& tissues, Distances TissueFidelity::*side)
{
  Distances all;
  for (const auto& [label, tissue] : tissues)
  {
    Distances sums = tissue.*side;
    sums.mean *= double(sums.samples);
    add(all, sums);
  }
  finish(all);
  return all;
}

} // namespace surgicalmesher
