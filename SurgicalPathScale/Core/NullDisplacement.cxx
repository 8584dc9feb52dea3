// SPDX-License-Identifier: Apache-2.0
#include "NullDisplacement.h"

#include "Errors.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <numeric>

namespace surgicalmesher
{

namespace
{

void checkOptions(const NullDisplacementOptions& options, const std::vector<Vec3>& targets,
                  const std::vector<Path>& paths)
{
  for (const double distance : { options.targetRadius, options.pathDistance, options.pathDistanceAtTarget })
  {
    if (!(std::isfinite(distance) && distance >= 0))
    {
      throw UsageError("a null-displacement distance is negative or not finite, expected 0 mm or more");
    }
  }
  if (options.targetRadius == 0 && options.pathDistance == 0)
  {
    throw UsageError("an output label map needs a null-displacement radius or path distance above 0 mm");
  }
  if (options.targetRadius > 0 && targets.empty())
    throw UsageError("a null-displacement radius is given, but no target");
  if (options.pathDistance > 0 && paths.empty())
    throw UsageError("a null-displacement path distance is given, but no path");
}

/// Tests whether points of the grid frame are near a target or path.
class Neighbourhood
{
public:
  Neighbourhood(const Grid& grid, const std::vector<Vec3>& targets, const std::vector<Path>& paths,
                const NullDisplacementOptions& options)
    : m_Options(options)
  {
    const auto toGrid = [&](const Vec3& point) { return grid.worldToGrid(point); };
    if (options.targetRadius > 0)
    {
      std::transform(targets.begin(), targets.end(), std::back_inserter(m_Targets), toGrid);
    }
    if (options.pathDistance == 0) return;
    if (m_Options.pathDistanceAtTarget == 0) m_Options.pathDistanceAtTarget = options.pathDistance;
    for (const Path& path : paths)
    {
      m_Paths.emplace_back();
      std::transform(path.begin(), path.end(), std::back_inserter(m_Paths.back()), toGrid);
    }
  }

  bool contains(const Vec3& x) const
  {
    if (distanceToPoints(x, m_Targets) <= m_Options.targetRadius) return true;
    return std::any_of(m_Paths.begin(), m_Paths.end(),
                       [&](const Path& path) {
                         return distanceToTube(x, path, m_Options.pathDistance, m_Options.pathDistanceAtTarget) <= 0;
                       });
  }

private:
  NullDisplacementOptions m_Options;
  std::vector<Vec3> m_Targets;
  std::vector<Path> m_Paths;
};

} // namespace

NullDisplacement markNullDisplacement(TissueMap& map, const std::vector<Vec3>& targets, const std::vector<Path>& paths,
                                      const NullDisplacementOptions& options)
{
  checkOptions(options, targets, paths);
  const Grid& grid = map.grid;
  const Neighbourhood kept(grid, targets, paths, options);
  std::vector<char> takesPart(65536, options.tissues.empty());
  takesPart[0] = false;
  for (const Label label : options.tissues) takesPart[label] = true;

  NullDisplacement result;
  const std::vector<Label> free = freeLabels(map, 1, options.named);
  if (free.empty()) throw InputError("all labels to 65535 are taken, none is left for null displacement");
  result.label = free.front();
  std::vector<std::size_t> changed(grid.size[2], 0); // by slice
  vtkSMPTools::For(0, grid.size[2],
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (int k = int(begin); k < int(end); ++k)
                     {
                       for (int j = 0; j < grid.size[1]; ++j)
                       {
                         for (int i = 0; i < grid.size[0]; ++i)
                         {
                           Label& label = map.labels[grid.index(i, j, k)];
                           if (!takesPart[label]) continue;
                           if (kept.contains({ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z })) continue;
                           label = result.label;
                           ++changed[k];
                         }
                       }
                     }
                   });
  result.voxelCount = std::accumulate(changed.begin(), changed.end(), std::size_t(0));
  if (result.voxelCount == 0) return result;
  map.table[result.label] = Tissue();
  map.table[result.label].name = "null displacement";
  map.table[result.label].isNullDisplacement = true;
  return result;
}

} // namespace surgicalmesher
