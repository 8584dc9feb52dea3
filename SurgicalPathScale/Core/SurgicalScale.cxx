// SPDX-License-Identifier: Apache-2.0
#include "SurgicalScale.h"

#include "Errors.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace surgicalmesher
{

namespace
{

std::string asText(double value)
{
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

void require(bool good, const char* what, double found, const char* expected)
{
  if (!good) throw UsageError(std::string(what) + " is " + asText(found) + ", expected " + expected);
}

void checkRange(const LengthRange& range)
{
  const auto isLength = [](double length) { return std::isfinite(length) && length > 0; };
  require(isLength(range.minimum), "the minimum edge length", range.minimum, "a finite number above 0 mm");
  require(isLength(range.maximum), "the maximum edge length", range.maximum, "a finite number above 0 mm");
  if (range.minimum <= range.maximum) return;
  throw UsageError("the minimum edge length, " + asText(range.minimum) + " mm, is above the maximum, " +
                   asText(range.maximum) + " mm");
}

void checkFalloff(const Falloff& falloff)
{
  require(std::isfinite(falloff.childRadius) && falloff.childRadius >= 0, "the child radius", falloff.childRadius,
          "a finite number of at least 0 mm");
  require(std::isfinite(falloff.decayLength) && falloff.decayLength > 0, "the decay length", falloff.decayLength,
          "a finite number above 0 mm");
}

void checkFocus(Combination combination, const std::vector<Vec3>& targets, const std::vector<Path>& paths)
{
  if (targets.empty() && paths.empty()) throw UsageError("neither a target nor a path is given, expected one or more");
  if (combination == Combination::Targets && targets.empty())
    throw UsageError("the targets alone count, but none is given");
  if (combination == Combination::Paths && paths.empty()) throw UsageError("the paths alone count, but none is given");
  for (const Path& path : paths)
  {
    if (path.size() < 2) throw InputError("a path of one point, expected two points or more");
  }
}

/// Returns the number of voxels of the scale volume along an axis. Surfaces extend up to a sixth of a map voxel beyond
/// the map, which must be covered too.
double voxelsAlong(const Grid& map, int axis, double spacing)
{
  constexpr double beyond = 0.2, tolerance = 1e-4; // rounding in headers of the same map must not matter here
  const double extent = map.size[axis] * map.spacing[axis];
  const double margin = std::max(1.0, std::ceil(beyond * map.spacing[axis] / spacing - tolerance));
  return std::ceil(extent / spacing - tolerance) + 2 * margin;
}

/// Lengths at a point, from its distances to the targets and paths.
class LengthFunction
{
public:
  LengthFunction(const SurgicalScaleOptions& options, const Vec3& x, const std::vector<Vec3>& targets,
                 const std::vector<Path>& paths)
    : m_Options(options)
  {
    if (options.combination != Combination::Paths) m_ToTarget = distanceToPoints(x, targets);
    if (options.combination != Combination::Targets) m_ToPath = distanceToPaths(x, paths);
  }

  double general() const { return within(m_Options.range); }
  double inTissue(Label label) const
  {
    const auto own = m_Options.tissues.find(label);
    return own == m_Options.tissues.end() ? general() : own->second.factor * within(own->second.range);
  }

private:
  double within(const LengthRange& range) const
  {
    return std::min(edgeLength(m_ToTarget, range, m_Options.targetFalloff, m_Options.rising),
                    edgeLength(m_ToPath, range, m_Options.pathFalloff, m_Options.rising));
  }

  const SurgicalScaleOptions& m_Options;
  double m_ToTarget = HUGE_VAL;
  double m_ToPath = HUGE_VAL;
};

/// Collects the labels of the map, each once and without background, in the box with sides of two scale voxels around a
/// point of the map's grid frame.
void labelsInBox(const TissueMap& map, const Vec3& centre, double halfSide, std::vector<Label>& labels)
{
  std::array<int, 3> from;
  std::array<int, 3> to;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double spacing = map.grid.spacing[axis];
    from[axis] = std::max(0, int(std::ceil((centre[axis] - halfSide) / spacing - 0.5)));
    to[axis] = std::min(map.grid.size[axis] - 1, int(std::floor((centre[axis] + halfSide) / spacing + 0.5)));
  }
  labels.clear();
  for (int k = from[2]; k <= to[2]; ++k)
  {
    for (int j = from[1]; j <= to[1]; ++j)
    {
      Label last = 0;
      for (int i = from[0]; i <= to[0]; ++i)
      {
        const Label label = map.labels[map.grid.index(i, j, k)];
        if (label == last || label == 0) continue;
        last = label;
        if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
      }
    }
  }
}

std::vector<Vec3> toGridFrame(const Grid& grid, std::vector<Vec3> points)
{
  for (Vec3& point : points) point = grid.worldToGrid(point);
  return points;
}

} // namespace

double edgeLengthOfArea(double area) { return std::sqrt(2 * area / std::sqrt(3)); }

double edgeLength(double distance, const LengthRange& range, const Falloff& falloff, RisingQuantity rising)
{
  const double beyond = std::max(0.0, distance - falloff.childRadius);
  const auto between = [&](double low, double high)
  { return low - (high - low) * std::expm1(-beyond / falloff.decayLength); };
  if (rising == RisingQuantity::Length) return between(range.minimum, range.maximum);
  return std::sqrt(between(range.minimum * range.minimum, range.maximum * range.maximum));
}

void checkScaleOptions(const SurgicalScaleOptions& options, const Grid& map, const std::vector<Vec3>& targets,
                       const std::vector<Path>& paths)
{
  checkRange(options.range);
  checkFalloff(options.targetFalloff);
  checkFalloff(options.pathFalloff);
  for (const auto& tissue : options.tissues)
  {
    checkRange(tissue.second.range);
    require(std::isfinite(tissue.second.factor) && tissue.second.factor > 0, "a tissue's factor", tissue.second.factor,
            "a finite number above 0");
  }
  require(std::isfinite(options.gradation) && options.gradation >= 0, "the gradation limit", options.gradation,
          "a finite number of at least 0");
  require(std::isfinite(options.spacing) && options.spacing > 0, "the spacing of the scale volume", options.spacing,
          "a finite number above 0 mm");
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) count *= voxelsAlong(map, axis, options.spacing);
  require(count < 2147483648.0, "the spacing of the scale volume", options.spacing,
          "a spacing that makes fewer than 2^31 voxels of this label map");
  checkFocus(options.combination, targets, paths);
}

Grid scaleGrid(const Grid& map, double spacing)
{
  Grid grid;
  grid.axes = map.axes;
  grid.spacing = { spacing, spacing, spacing };
  Vec3 corner;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.size[axis] = int(voxelsAlong(map, axis, spacing));
    corner[axis] = ((map.size[axis] - 1) * map.spacing[axis] - (grid.size[axis] - 1) * spacing) / 2;
  }
  grid.origin = map.gridToWorld(corner);
  return grid;
}

ScaleField computeSurgicalScale(const TissueMap& map, const std::vector<Vec3>& targets, const std::vector<Path>& paths,
                                const SurgicalScaleOptions& options, const Progress& progress)
{
  checkScaleOptions(options, map.grid, targets, paths);
  ScaleField scale;
  scale.grid = scaleGrid(map.grid, options.spacing);
  scale.lengths.resize(scale.grid.voxelCount());
  // In the grid frame, a map and its rotated copy have the same coordinates up to rounding.
  const std::vector<Vec3> gridTargets = toGridFrame(map.grid, targets);
  std::vector<Path> gridPaths;
  for (const Path& path : paths) gridPaths.push_back(toGridFrame(map.grid, path));
  const Vec3 first = map.grid.worldToGrid(scale.grid.origin);

  report(progress, 0, "edge lengths");
  vtkSMPTools::For(0, scale.grid.size[2],
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     std::vector<Label> labels;
                     for (int k = int(begin); k < int(end); ++k)
                     {
                       for (int j = 0; j < scale.grid.size[1]; ++j)
                       {
                         for (int i = 0; i < scale.grid.size[0]; ++i)
                         {
                           const Vec3 x = first + options.spacing * Vec3{ double(i), double(j), double(k) };
                           const LengthFunction length(options, x, gridTargets, gridPaths);
                           if (!options.tissues.empty()) labelsInBox(map, x, options.spacing, labels);
                           double smallest = labels.empty() ? length.general() : HUGE_VAL;
                           for (const Label label : labels) smallest = std::min(smallest, length.inTissue(label));
                           scale.lengths[scale.grid.index(i, j, k)] = float(smallest);
                         }
                       }
                     }
                   });
  if (options.gradation > 0)
  {
    report(progress, 0.5, "gradation");
    limitGradation(scale, options.gradation);
  }
  report(progress, 1, "edge lengths");
  return scale;
}

namespace
{

/// Returns the distance from a target up to which the length is at most 1.5 times the minimum.
double reach(const LengthRange& range, const Falloff& falloff, RisingQuantity rising)
{
  const double power = rising == RisingQuantity::Area ? 2 : 1;
  const double low = std::pow(range.minimum, power), high = std::pow(range.maximum, power);
  const double share = (std::pow(1.5, power) - 1) * low / (high - low); // of the rise
  return share < 1 ? falloff.childRadius - falloff.decayLength * std::log1p(-share) : HUGE_VAL;
}

} // namespace

double sufficientSpacing(const SurgicalScaleOptions& options, const std::vector<Vec3>& targets,
                         const std::vector<Path>& paths)
{
  std::vector<Falloff> falloffs;
  if (options.combination != Combination::Paths && !targets.empty()) falloffs.push_back(options.targetFalloff);
  if (options.combination != Combination::Targets && !paths.empty()) falloffs.push_back(options.pathFalloff);
  double least = HUGE_VAL;
  for (const Falloff& falloff : falloffs)
  {
    least = std::min(least, reach(options.range, falloff, options.rising));
    for (const auto& tissue : options.tissues)
      least = std::min(least, reach(tissue.second.range, falloff, options.rising));
  }
  return least / std::sqrt(3); // the diagonal of a voxel: all eight voxel centres around a point are within it
}

} // namespace surgicalmesher
