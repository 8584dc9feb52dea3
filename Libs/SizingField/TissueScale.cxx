// SPDX-License-Identifier: Apache-2.0
#include "TissueScale.h"

#include "BoundaryFaces.h"
#include "Gradation.h"
#include "LabelRuns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

constexpr float unlimited = std::numeric_limits<float>::infinity();

/// Limits on L at the voxels of a scale volume.
class LengthLimits
{
public:
  LengthLimits(const ScaleField& scale, const Grid& map)
    : minima(scale.lengths.size(), 0), maxima(scale.lengths.size(), unlimited), m_Scale(scale.grid), m_Map(map)
  {
    // Half the extent of a voxel of the map along the axes of the scale.
    for (int axis = 0; axis < 3; ++axis)
    {
      m_HalfVoxel[axis] = 0;
      for (int a = 0; a < 3; ++a)
        m_HalfVoxel[axis] += std::abs(dot(m_Scale.axes[axis], map.axes[a])) * map.spacing[a] / 2;
    }
  }

  std::vector<float> minima, maxima;

  /// Calls visit(index) for the scale's voxels that interpolation within a voxel of the map uses.
  template <typename Visit>
  void visitAround(std::size_t voxel, const Visit& visit) const
  {
    const Vec3 p = m_Scale.worldToGrid(worldOf(voxel));
    std::array<int, 3> from, to;
    for (int axis = 0; axis < 3; ++axis)
    {
      constexpr double rounding = 1e-6; // of headers, in voxels: a node exactly at the edge has no weight
      const double last = m_Scale.size[axis] - 1;
      const auto clamped = [&](double index) { return int(std::min(last, std::max(0.0, index))); };
      from[axis] = clamped(std::floor((p[axis] - m_HalfVoxel[axis]) / m_Scale.spacing[axis] + rounding));
      to[axis] = clamped(std::ceil((p[axis] + m_HalfVoxel[axis]) / m_Scale.spacing[axis] - rounding));
    }
    for (int k = from[2]; k <= to[2]; ++k)
    {
      for (int j = from[1]; j <= to[1]; ++j)
      {
        for (int i = from[0]; i <= to[0]; ++i) visit(m_Scale.index(i, j, k));
      }
    }
  }

  /// Clamps L to the limits, and lets it rise by at most `gradation` per mm around places where this lowered it.
  void apply(ScaleField& scale, double gradation) const
  {
    ScaleField lowered = scale;
    bool any = false;
    for (std::size_t n = 0; n < scale.lengths.size(); ++n)
    {
      const float within = limited(scale.lengths[n], n);
      lowered.lengths[n] = within < scale.lengths[n] ? within : unlimited;
      any = any || within < scale.lengths[n];
      scale.lengths[n] = within;
    }
    if (!any || gradation <= 0) return;
    limitGradation(lowered, gradation);
    for (std::size_t n = 0; n < scale.lengths.size(); ++n)
      scale.lengths[n] = limited(std::min(scale.lengths[n], lowered.lengths[n]), n);
  }

private:
  float limited(float length, std::size_t n) const { return std::min(std::max(length, minima[n]), maxima[n]); }

  Vec3 worldOf(std::size_t voxel) const
  {
    const auto [i, j, k] = m_Map.voxelAt(voxel);
    return m_Map.gridToWorld(m_Map.position(i, j, k));
  }

  Grid m_Scale, m_Map;
  std::array<double, 3> m_HalfVoxel;
};

bool hasLengths(const TissueSetting& setting) { return setting.minimumEdgeLength > 0 || setting.maximumEdgeLength > 0; }

/// Calls visit(voxel, setting) for every voxel of a tissue in `settings`.
template <typename Visit>
void visitVoxels(const TissueMap& map, const TissueSettings& settings, const Visit& visit)
{
  std::vector<const TissueSetting*> byLabel(std::size_t(1) << 16, nullptr);
  for (const auto& [label, setting] : settings) byLabel[label] = &setting;
  forEachLabelRun(map.labels, 0, map.labels.size(),
                  [&](Label label, std::size_t begin, std::size_t end)
                  {
                    for (std::size_t v = begin; byLabel[label] && v < end; ++v) visit(v, *byLabel[label]);
                  });
}

constexpr double flattest = 0.32, smallest = 0.75; // ratios of thickness and of extent to L

/// The dimensions of a tissue, mm.
struct Extent
{
  double thickness = 0; ///< mean
  double size = 0;      ///< cube root of the volume
};

/// The longest edges, mm, with which a tissue keeps its volume that is flatter than near-regular tetrahedra of edge
/// `length` can be; `length` itself for other tissues.
double mostIfFlat(const Extent& extent, double length)
{
  constexpr double flatness = 0.5, leastSize = 0.9;
  const bool isFlat = extent.thickness < flattest * length && extent.size > leastSize * length;
  return isFlat ? extent.thickness / flatness : length;
}

/// The same for a tissue that is small in every direction.
double mostIfSmall(const Extent& extent, double length, double voxel)
{
  constexpr double enough = 8; // voxels
  return std::min(length, std::max(extent.size / smallest, enough * voxel));
}

/// The mean of L within each of the `wanted` labels, mm.
std::map<Label, double> meanLengths(const ScaleField& scale, const TissueMap& map, const std::vector<bool>& wanted)
{
  const Vec3& h = map.grid.spacing;
  std::vector<std::map<Label, std::pair<double, std::size_t>>> lengths(map.grid.size[2]); // by slice: sum and number
  parallelForEach(lengths.size(),
                  [&](std::size_t k)
                  {
                    for (int j = 0; j < map.grid.size[1]; ++j)
                      for (int i = 0; i < map.grid.size[0]; ++i)
                        if (const Label label = map.labels[map.grid.index(i, j, int(k))]; wanted[label])
                        {
                          auto& [sum, number] = lengths[k][label];
                          sum += scale(map.grid.gridToWorld({ i * h.x, j * h.y, k * h.z }));
                          ++number;
                        }
                  });
  std::map<Label, std::pair<double, std::size_t>> all;
  for (const auto& slice : lengths)
    for (const auto& [label, of] : slice) all[label].first += of.first, all[label].second += of.second;
  std::map<Label, double> result;
  for (const auto& [label, of] : all) result[label] = of.first / double(of.second);
  return result;
}

} // namespace

ScaleField scaleVolume(const ScaleField& scale, const Grid& map)
{
  if (scale.lengths.size() > 1) return scale;
  ScaleField volume;
  volume.grid = map;
  for (int axis = 0; axis < 3; ++axis)
  {
    volume.grid.size[axis] = map.size[axis] / 2 + 2; // from one voxel before the first to at least one after the last
    volume.grid.spacing[axis] = 2 * map.spacing[axis];
  }
  volume.grid.origin = map.gridToWorld(-1 * map.spacing);
  volume.lengths.assign(volume.grid.voxelCount(), scale.lengths.at(0));
  return volume;
}

void completeShells(TissueSettings& settings, const TissueMap& map, const ScaleField& scale)
{
  TissueSettings open;
  for (const auto& [label, setting] : settings)
  {
    if (setting.role == TissueRole::Shell && !hasLengths(setting)) open.emplace(label, setting);
  }
  if (open.empty()) return;
  std::map<Label, double> least;
  visitVoxels(map, open,
              [&](std::size_t v, const TissueSetting&)
              {
                const auto [i, j, k] = map.grid.voxelAt(v);
                const double length = scale(map.grid.gridToWorld(map.grid.position(i, j, k)));
                const auto [entry, isNew] = least.emplace(map.labels[v], length);
                if (!isNew) entry->second = std::min(entry->second, length);
              });
  for (const auto& [label, length] : least)
    settings[label].minimumEdgeLength = settings[label].maximumEdgeLength = length;
}

ScaleField followTissues(const ScaleField& scale, const TissueMap& map, const TissueSettings& settings,
                         double gradation)
{
  TissueSettings solids, shells;
  for (const auto& [label, setting] : settings)
  {
    if (hasLengths(setting)) (setting.role == TissueRole::Shell ? shells : solids).emplace(label, setting);
  }
  if (solids.empty() && shells.empty()) return scale;
  ScaleField result = scaleVolume(scale, map.grid);
  LengthLimits limits(result, map.grid);
  visitVoxels(map, solids,
              [&](std::size_t v, const TissueSetting& setting)
              {
                const float minimum = float(setting.minimumEdgeLength);
                const float maximum = setting.maximumEdgeLength > 0 ? float(setting.maximumEdgeLength) : unlimited;
                limits.visitAround(v,
                                   [&](std::size_t n)
                                   {
                                     limits.minima[n] = std::max(limits.minima[n], minimum);
                                     limits.maxima[n] = std::min(limits.maxima[n], maximum);
                                   });
              });
  std::vector<float> shellLengths(shells.empty() ? 0 : result.lengths.size(), unlimited);
  visitVoxels(map, shells,
              [&](std::size_t v, const TissueSetting& setting)
              {
                limits.visitAround(v, [&](std::size_t n)
                                   { shellLengths[n] = std::min(shellLengths[n], float(setting.maximumEdgeLength)); });
              });
  for (std::size_t n = 0; n < shellLengths.size(); ++n)
  {
    if (shellLengths[n] < unlimited) limits.minima[n] = limits.maxima[n] = shellLengths[n];
  }
  limits.apply(result, gradation);
  return result;
}

ScaleField followThickness(const ScaleField& scale, const TissueMap& map, const std::vector<ThinVoxel>& thinVoxels,
                           double gradation)
{
  const Vec3& s = map.grid.spacing;
  const float least = float(std::min({ s.x, s.y, s.z }));
  ScaleField result = scaleVolume(scale, map.grid);
  LengthLimits limits(result, map.grid);
  for (const ThinVoxel& thin : thinVoxels)
  {
    const float length = std::max(least, thin.thickness);
    limits.visitAround(thin.voxel, [&](std::size_t n) { limits.maxima[n] = std::min(limits.maxima[n], length); });
  }
  limits.apply(result, gradation);
  return result;
}

ScaleField followCurvature(const ScaleField& scale, const TissueMap& map, const std::vector<CurvedVoxel>& curvedVoxels,
                           double chordError, double gradation)
{
  const bool isUniform = scale.lengths.size() == 1;
  const double least =
    isUniform ? map.grid.smallestSpacing() : double(*std::min_element(scale.lengths.begin(), scale.lengths.end()));
  ScaleField result = scaleVolume(scale, map.grid);
  LengthLimits limits(result, map.grid);
  for (const CurvedVoxel& curved : curvedVoxels)
  {
    const float length = float(std::max(least, std::sqrt(8 * chordError / std::max(curved.curvature, 1e-12))));
    limits.visitAround(curved.voxel, [&](std::size_t n) { limits.maxima[n] = std::min(limits.maxima[n], length); });
  }
  limits.apply(result, gradation);
  return result;
}

std::map<Label, double> meanThickness(const TissueMap& map)
{
  constexpr double staircase = 1.5;
  constexpr std::size_t parts = 8; // each part stores a sum for every label
  const Vec3 h = map.grid.spacing;
  const double area[3] = { h.y * h.z / staircase, h.z * h.x / staircase, h.x * h.y / staircase };
  const std::size_t slices = std::size_t(map.grid.size[2]) + 1;
  std::vector<std::vector<double>> surface(parts, std::vector<double>(labelCount));
  parallelForEach(parts,
                  [&](std::size_t n)
                  {
                    const auto addFace = [&](const VoxelFace& face)
                    {
                      surface[n][labelAt(map, face.lower)] += area[face.axis];
                      surface[n][labelAt(map, face.upper())] += area[face.axis];
                    };
                    for (std::size_t k = n * slices / parts; k < (n + 1) * slices / parts; ++k)
                      forEachBoundaryFace(map, int(k) - 1, addFace);
                  });
  std::map<Label, double> result;
  for (const auto& [label, voxels] : countVoxels(map))
  {
    double sum = 0;
    for (const std::vector<double>& part : surface) sum += part[label];
    if (label != 0) result[label] = 2 * double(voxels) * h.x * h.y * h.z / sum;
  }
  return result;
}

ScaleField followSmallTissues(const ScaleField& scale, const TissueMap& map, const std::map<Label, double>& thickness)
{
  const Vec3& h = map.grid.spacing;
  const double longest = *std::max_element(scale.lengths.begin(), scale.lengths.end());
  const double voxel = map.grid.smallestSpacing();
  std::map<Label, Extent> extents;
  std::vector<bool> mayBeSmall(labelCount, false);
  for (const auto& [label, voxels] : countVoxels(map))
  {
    if (label == 0) continue;
    const Extent extent{ thickness.at(label), std::cbrt(double(voxels) * h.x * h.y * h.z) };
    mayBeSmall[label] = extent.thickness < flattest * longest || extent.size < smallest * longest;
    extents[label] = extent;
  }
  constexpr double gradation = 0.5; // without it, small surfaces would grow towards the longer edges around them
  TissueSettings flat, small;
  for (const auto& [label, length] : meanLengths(scale, map, mayBeSmall))
  {
    if (const double most = mostIfFlat(extents[label], length); most < length) flat[label].maximumEdgeLength = most;
    else if (const double limit = mostIfSmall(extents[label], length, voxel); limit < length)
      small[label].maximumEdgeLength = limit;
  }
  return followTissues(followTissues(scale, map, flat, 0), map, small, gradation);
}

} // namespace surgicalmesher
