// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Null-displacement tissue: tissue far from every target and path, which the simulation holds fixed because it is not
/// worth elements of its own (Audette et al., Computer Aided Surgery 12(1), 2007, fig. 8).

#include "Distance.h"
#include "TissueMap.h"

#include <cstddef>
#include <set>
#include <vector>

namespace surgicalmesher
{

struct NullDisplacementOptions
{
  double targetRadius = 0; ///< mm; voxels within this distance of a target keep their label; 0: targets are ignored
  double pathDistance = 0; ///< mm; voxels within this distance of a path keep their label; 0: paths are ignored
  /// Path distance at the target end of paths, mm; along a path, the distance varies linearly with arc length from
  /// pathDistance at the entry to this value. 0: constant along the path.
  double pathDistanceAtTarget = 0;
  std::set<Label> tissues; ///< tissues that may become null displacement; empty: all but background
  std::set<Label> named{}; ///< labels with names in a table, whether or not they occur in the map
};

struct NullDisplacement
{
  Label label = 0;
  std::size_t voxelCount = 0;
};

/// Gives a single label, named and marked as null displacement in map.table, to all voxels of the selected tissues
/// whose centres are farther than the radius from every target AND outside the tube around every path (see
/// distanceToTube). The label is a free one (see freeLabels). Throws UsageError if no criterion is used, if one is used
/// without a target or path, or if a distance is negative or not finite; InputError if no label is free.
NullDisplacement markNullDisplacement(TissueMap& map, const std::vector<Vec3>& targets, const std::vector<Path>& paths,
                                      const NullDisplacementOptions& options);

} // namespace surgicalmesher
