#pragma once
/// Simplification of the tissue map at the scale that the mesh is asked for.
///
/// Detail much smaller than the elements costs many elements and means little: far from the target, islands, cavities,
/// tunnels, handles and necks smaller than s(x) = F L(x) go, where L is the target edge length. Two local rules do it:
/// - a region (an island of a tissue, a pocket of background) of less than s^3 goes to the labels around it;
/// - a voxel of which the own label fills too small a share of the ball of diameter s around it goes to the label
///   beside it that fills the most. A flat boundary leaves a voxel half the ball, and the surface of a ball as large as
///   s still 5/16: what is larger than s stays where it is, while a strand, a thin wall or a narrow passage gives way.
/// The second is threshold dynamics (Merriman, Bence and Osher 1992) with a margin: without one, every round would move
/// every boundary that is not flat. It takes as many rounds as s has voxels, and a last search for small regions
/// follows. A narrow passage through a wall that is itself thin can remain.

#include "DigitalTopology.h"
#include "Progress.h"
#include "ScaleField.h"
#include "TissueMap.h"

#include <cstddef>
#include <map>
#include <set>

namespace surgicalmesher
{

struct FeatureOptions
{
  double featureScale = 0;         ///< F; 0 changes nothing
  std::set<Label> protectedLabels; ///< keep every voxel and gain none; label 0 protects the background
};

struct FeatureChanges
{
  std::size_t regionsRemoved = 0;     ///< islands; of label 0, pockets
  std::size_t regionVoxels = 0;       ///< voxels in them that belong to another label now
  std::size_t thinVoxelsLost = 0;     ///< of handles, necks, walls and ends, to other labels
  std::size_t narrowVoxelsGained = 0; ///< in tunnels, cavities and clefts, from other labels (removed regions included)
  Betti before, after;                ///< what that did to the tissue's topology; zero for label 0
};

struct FeatureReport
{
  std::map<Label, FeatureChanges> changes; ///< only tissues with a change
  std::set<Label> keptWhole;               ///< tissues that would have lost more than half: left as if protected
  std::size_t voxelsChanged = 0;
};

/// Simplifies the map at `scale`. A voxel changes only where s(x) is at least the smallest voxel spacing; sizes over 16
/// of that spacing count as 16. No tissue disappears. Deterministic. The map may hold new diagonal contacts afterwards:
/// prepareMap() comes next. If `progress` throws, the map is as it was.
FeatureReport simplifyFeatures(TissueMap& map, const ScaleField& scale, const FeatureOptions& options,
                               const Progress& progress = {});

} // namespace surgicalmesher
