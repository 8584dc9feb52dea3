// SPDX-License-Identifier: Apache-2.0
#include "LocalThickness.h"

#include "BoundaryFaces.h"
#include "PaddedMap.h"
#include "Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace surgicalmesher
{
namespace
{

constexpr int margin = 2; // voxels that outwardNormal() reads; of background, so that every chord ends there

/// Chords through voxels of a padded map.
class Chords
{
public:
  explicit Chords(const TissueMap& paddedMap) : m_Map(paddedMap)
  {
    const std::ptrdiff_t j = paddedMap.grid.size[0];
    m_Strides = { 1, j, j * paddedMap.grid.size[1] };
  }

  /// Area of the voxel's faces towards other labels, mm^2.
  double exposedArea(std::size_t voxel) const
  {
    const Vec3& s = m_Map.grid.spacing;
    const std::array<double, 3> faces{ s.y * s.z, s.x * s.z, s.x * s.y };
    double area = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const std::ptrdiff_t step : { -m_Strides[axis], m_Strides[axis] })
        area += m_Map.labels[voxel + step] != m_Map.labels[voxel] ? faces[axis] : 0;
    }
    return area;
  }

  /// Thickness at the centre of the voxel, mm; any value of at least `limit` if it is not below `limit`.
  double thickness(std::size_t voxel, double limit) const
  {
    const Vec3& s = m_Map.grid.spacing;
    const double fewVoxels = 3.5 * std::max({ s.x, s.y, s.z });
    const Vec3 normal = outwardNormal(voxel);
    const bool hasNormal = squaredNorm(normal) > 0;
    const double alongNormal = hasNormal ? chord(voxel, normal, limit) : 0;
    if (hasNormal && alongAxes(voxel, std::min(fewVoxels, limit))[0] >= fewVoxels) return alongNormal;
    const std::array<double, 3> along = alongAxes(voxel, limit);
    if (!hasNormal) return along[0];
    const bool isFlat = along[0] < fewVoxels && along[1] >= std::min(4 * along[0], limit);
    return isFlat ? std::min(alongNormal, along[0]) : alongNormal;
  }

private:
  /// Lengths of the chords along the three axes, ascending.
  std::array<double, 3> alongAxes(std::size_t voxel, double limit) const
  {
    std::array<double, 3> along;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double outwards = reachAlong(axis, m_Strides[axis], voxel, limit);
      along[axis] =
        outwards < limit ? outwards + reachAlong(axis, -m_Strides[axis], voxel, limit - outwards) : outwards;
    }
    std::sort(along.begin(), along.end());
    return along;
  }

  /// Unit normal, or 0 if the labels around the voxel give no direction.
  Vec3 outwardNormal(std::size_t voxel) const
  {
    const Label own = m_Map.labels[voxel];
    std::array<int, 3> sum{ 0, 0, 0 };
    for (int dk = -margin; dk <= margin; ++dk)
    {
      for (int dj = -margin; dj <= margin; ++dj)
      {
        const Label* row = m_Map.labels.data() + voxel + dj * m_Strides[1] + dk * m_Strides[2];
        int others = 0;
        for (int di = -margin; di <= margin; ++di)
        {
          const int isOther = row[di] != own; // no branch, as it would be unpredictable
          others += isOther;
          sum[0] += isOther * di;
        }
        sum[1] += others * dj;
        sum[2] += others * dk;
      }
    }
    const Vec3& s = m_Map.grid.spacing;
    const Vec3 direction{ sum[0] / s.x, sum[1] / s.y, sum[2] / s.z }; // a gradient
    const double length = norm(direction);
    return length > 0 ? direction / length : Vec3{};
  }

  double chord(std::size_t voxel, const Vec3& direction, double limit) const
  {
    const double outwards = reach(voxel, direction, limit);
    return outwards < limit ? outwards + reach(voxel, -direction, limit - outwards) : outwards;
  }

  /// Distance from the centre of the voxel along an axis to where its label ends; followed up to `limit`.
  double reachAlong(int axis, std::ptrdiff_t step, std::size_t voxel, double limit) const
  {
    const Label own = m_Map.labels[voxel];
    const double between = m_Map.grid.spacing[axis];
    for (double way = between / 2;; way += between)
    {
      voxel += step;
      if (way >= limit || m_Map.labels[voxel] != own) return way;
    }
  }

  /// The same in any direction, face by face (Amanatides and Woo 1987).
  double reach(std::size_t voxel, const Vec3& direction, double limit) const
  {
    std::array<double, 3> next, between; // distance to the next face across each axis, and between faces
    std::array<std::ptrdiff_t, 3> steps;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double speed = std::abs(direction[axis]);
      between[axis] = speed > 0 ? m_Map.grid.spacing[axis] / speed : HUGE_VAL;
      next[axis] = between[axis] / 2;
      steps[axis] = direction[axis] < 0 ? -m_Strides[axis] : m_Strides[axis];
    }
    const Label own = m_Map.labels[voxel];
    for (;;)
    {
      const int axis = int(std::min_element(next.begin(), next.end()) - next.begin());
      const double way = next[axis];
      voxel += steps[axis];
      if (way >= limit || m_Map.labels[voxel] != own) return way;
      next[axis] += between[axis];
    }
  }

  const TissueMap& m_Map;
  std::array<std::ptrdiff_t, 3> m_Strides;
};

/// Measures slice k of the map.
LocalThickness measureSlice(const Grid& grid, const TissueMap& paddedMap, const ScaleField& scale, int k)
{
  const Chords chords(paddedMap);
  LocalThickness result;
  const auto measure = [&](std::size_t inPadded, int i, int j)
  {
    const Label label = paddedMap.labels[inPadded];
    if (label == 0) return;
    const double area = chords.exposedArea(inPadded);
    TissueThickness& tissue = result.tissues[label];
    tissue.area += area;
    const double length = scale(grid.gridToWorld(grid.position(i, j, k)));
    const double thickness = chords.thickness(inPadded, length);
    if (!(thickness < length)) return;
    tissue.smallest = tissue.thinArea == 0 ? thickness : std::min(tissue.smallest, thickness);
    tissue.thinArea += area;
    result.thinVoxels.push_back({ grid.index(i, j, k), float(thickness) });
  };
  for (int j = 0; j < grid.size[1]; ++j)
  {
    const std::size_t first = paddedMap.grid.index(margin, j + margin, k + margin);
    forEachBoundaryVoxel(paddedMap, j + margin, k + margin, margin, margin + grid.size[0],
                         [&](std::size_t inPadded) { measure(inPadded, int(inPadded - first), j); });
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
  const TissueMap paddedMap = padded(map, margin);
  std::vector<LocalThickness> slices(map.grid.size[2]);
  parallelForEach(slices.size(), [&](std::size_t k) { slices[k] = measureSlice(map.grid, paddedMap, scale, int(k)); });
  LocalThickness result;
  for (const LocalThickness& slice : slices) append(result, slice);
  return result;
}

} // namespace surgicalmesher
