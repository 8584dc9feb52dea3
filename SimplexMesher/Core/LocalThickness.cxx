#include "LocalThickness.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surgicalmesher
{
namespace
{

constexpr std::array<std::array<int, 3>, 6> faceSteps{
  { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 }, { 0, 0, 1 } }
};

class Chords
{
public:
  explicit Chords(const TissueMap& map)
    : m_Map(map), m_Step(std::min({ map.grid.spacing.x, map.grid.spacing.y, map.grid.spacing.z }) / 4)
  {
  }

  Label at(int i, int j, int k) const
  {
    return m_Map.grid.contains(i, j, k) ? m_Map.labels[m_Map.grid.index(i, j, k)] : Label(0);
  }

  /// mm^2 of voxel (i, j, k) that other labels touch.
  double exposedArea(int i, int j, int k) const
  {
    const Vec3& s = m_Map.grid.spacing;
    const Label own = at(i, j, k);
    double area = 0;
    for (const auto& [di, dj, dk] : faceSteps)
    {
      if (at(i + di, j + dj, k + dk) != own) area += di ? s.y * s.z : dj ? s.x * s.z : s.x * s.y;
    }
    return area;
  }

  /// Thickness at the centre of voxel (i, j, k), mm; anything from `limit` on if it is not below that.
  double thickness(int i, int j, int k, double limit) const
  {
    const Vec3& s = m_Map.grid.spacing;
    const Vec3 centre{ i * s.x, j * s.y, k * s.z };
    std::array<double, 3> along{ chord(centre, { 1, 0, 0 }, limit), chord(centre, { 0, 1, 0 }, limit),
                                 chord(centre, { 0, 0, 1 }, limit) };
    std::sort(along.begin(), along.end());
    const Vec3 normal = outwardNormal(i, j, k);
    if (squaredNorm(normal) == 0) return along[0];
    const double alongNormal = chord(centre, normal, limit);
    const bool isFlat = along[0] < 3.5 * std::max({ s.x, s.y, s.z }) && along[1] >= std::min(4 * along[0], limit);
    return isFlat ? std::min(alongNormal, along[0]) : alongNormal;
  }

private:
  /// Of unit length, or 0 if the labels around show no direction.
  Vec3 outwardNormal(int i, int j, int k) const
  {
    constexpr int reach = 2;
    const Label own = at(i, j, k);
    std::array<int, 3> sum{ 0, 0, 0 };
    for (int dk = -reach; dk <= reach; ++dk)
    {
      for (int dj = -reach; dj <= reach; ++dj)
      {
        for (int di = -reach; di <= reach; ++di)
        {
          if (at(i + di, j + dj, k + dk) == own) continue;
          sum[0] += di, sum[1] += dj, sum[2] += dk;
        }
      }
    }
    const Vec3& s = m_Map.grid.spacing;
    const Vec3 direction{ sum[0] / s.x, sum[1] / s.y, sum[2] / s.z }; // a gradient
    const double length = norm(direction);
    return length > 0 ? direction / length : Vec3{};
  }

  double chord(const Vec3& centre, const Vec3& direction, double limit) const
  {
    const double outwards = reach(centre, direction, limit);
    return outwards + reach(centre, -direction, limit - outwards);
  }

  /// How far one stays in the label, to the middle of a step.
  double reach(const Vec3& from, const Vec3& direction, double limit) const
  {
    const Label own = labelAt(from);
    double way = m_Step / 2;
    while (way < limit + m_Step && labelAt(from + way * direction) == own) way += m_Step;
    return way - m_Step / 2;
  }

  Label labelAt(const Vec3& p) const
  {
    const Vec3& s = m_Map.grid.spacing;
    return at(int(std::floor(p.x / s.x + 0.5)), int(std::floor(p.y / s.y + 0.5)), int(std::floor(p.z / s.z + 0.5)));
  }

  const TissueMap& m_Map;
  double m_Step;
};

/// Slice k of the map.
LocalThickness measureSlice(const TissueMap& map, const ScaleField& scale, int k)
{
  const Chords chords(map);
  const Grid& grid = map.grid;
  LocalThickness result;
  for (int j = 0; j < grid.size[1]; ++j)
  {
    for (int i = 0; i < grid.size[0]; ++i)
    {
      const std::size_t voxel = grid.index(i, j, k);
      const Label label = map.labels[voxel];
      const double area = label == 0 ? 0 : chords.exposedArea(i, j, k);
      if (area == 0) continue;
      TissueThickness& tissue = result.tissues[label];
      tissue.area += area;
      const double length = scale(grid.gridToWorld({ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z }));
      const double thickness = chords.thickness(i, j, k, length);
      if (!(thickness < length)) continue;
      tissue.smallest = tissue.thinArea == 0 ? thickness : std::min(tissue.smallest, thickness);
      tissue.thinArea += area;
      result.thinVoxels.push_back({ voxel, float(thickness) });
    }
  }
  return result;
}

void append(LocalThickness& all, const LocalThickness& more)
{
  for (const auto& [label, tissue] : more.tissues)
  {
    TissueThickness& sum = all.tissues[label];
    if (tissue.thinArea > 0)
      sum.smallest = sum.thinArea == 0 ? tissue.smallest : std::min(sum.smallest, tissue.smallest);
    sum.area += tissue.area;
    sum.thinArea += tissue.thinArea;
  }
  all.thinVoxels.insert(all.thinVoxels.end(), more.thinVoxels.begin(), more.thinVoxels.end());
}

} // namespace

LocalThickness measureThickness(const TissueMap& map, const ScaleField& scale)
{
  std::vector<LocalThickness> slices(map.grid.size[2]);
  vtkSMPTools::For(0, map.grid.size[2],
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (vtkIdType k = begin; k < end; ++k) slices[k] = measureSlice(map, scale, int(k));
                   });
  LocalThickness result;
  for (const LocalThickness& slice : slices) append(result, slice);
  return result;
}

} // namespace surgicalmesher
