// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tissue that the simulation holds still: far from every target and path it is not worth elements of its own
/// (null-displacement tissue: Audette et al., Computer Aided Surgery 12(1), 2007, fig. 8).

#include "Distance.h"
#include "TissueMap.h"

#include <cstddef>
#include <set>
#include <vector>

namespace surgicalmesher
{

struct NullDisplacementOptions
{
  double targetRadius = 0; ///< mm; voxels this near to a target keep their label; 0: targets don't count
  double pathDistance = 0; ///< mm; voxels this near to a path keep their label; 0: paths don't count
  /// mm; the path distance goes linearly with arc length from pathDistance at the entry to this at the target end; 0:
  /// it is the same all along.
  double pathDistanceAtTarget = 0;
  std::set<Label> tissues; ///< that may become null displacement; empty: all but background
  std::set<Label> named{}; ///< labels that a table has names for, in the map or not
};

struct NullDisplacement
{
  Label label = 0;
  std::size_t voxelCount = 0;
};

/// Gives one label, marked and named as null displacement in map.table, to all voxels of the tissues that take part
/// whose centres are farther than the radius from every target AND outside the tube around every path (see
/// distanceToTube). The label is a free one (see freeLabels). Throws UsageError if neither criterion is used, one
/// is used without a target or path, or a distance is negative or not finite; InputError if no label is free.
NullDisplacement markNullDisplacement(TissueMap& map, const std::vector<Vec3>& targets, const std::vector<Path>& paths,
                                      const NullDisplacementOptions& options);

} // namespace surgicalmesher
