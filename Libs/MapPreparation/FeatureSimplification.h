// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Simplification of the tissue map at the scale that the mesh is asked for.
///
/// Detail much smaller than the elements costs many elements and means little: far from the target, islands, cavities,
/// tunnels, handles and necks smaller than s(x) = F L(x) go, where L is the target edge length. Two local rules do it:
/// - a region (an island of a tissue, a pocket of background) of less than s^3 goes to the labels around it;
/// - a voxel of which the own label fills too small a share of the ball of diameter s around it goes to the label
///   beside it that fills the most. A flat boundary leaves a voxel half the ball, and the surface of a long strand as
///   thick as s two fifths: strands, thin walls and narrow passages give way, and what is flat or gently rounded stays
///   where it is. A compact piece keeps its surface from about one and a half s on.
/// The second is threshold dynamics (Merriman, Bence and Osher 1992) with a margin: without one, every round would move
/// every boundary that is not flat. It takes as many rounds as s has voxels, and a last search for small regions
/// follows. A narrow passage through a wall that is itself thin can remain.

#include "PaddedMap.h"
#include "Progress.h"
#include "ScaleField.h"

#include <cstddef>
#include <set>

namespace surgicalmesher
{

struct FeatureOptions
{
  double featureScale = 0;         ///< F; 0 changes nothing
  std::set<Label> protectedLabels; ///< keep every voxel and gain none; label 0 protects the background
};

/// The margin that the balls of simplifyFeatures() need: the largest reaches over the map's border by so many voxels.
int featureMargin(const Grid& grid, const ScaleField& scale, double featureScale);

/// Simplifies the map, which has featureMargin() around it, at `scale`. A voxel changes only where s(x) is at least the smallest voxel spacing; sizes over 16
/// of that spacing count as 16. No tissue disappears: one that would lose more than half of its voxels is left as if
/// protected, and these are returned. Deterministic. The map may hold new diagonal contacts afterwards. If `progress`
/// throws, the map is as it was.
std::set<Label> simplifyFeatures(PaddedMap& map, const ScaleField& scale, const FeatureOptions& options,
                                 const Progress& progress = {});

/// Whether s(x) is below the smallest voxel spacing at the voxel that lies at `voxel` in memory.
bool isBelowScale(const PaddedMap& map, const ScaleField& scale, double featureScale, std::size_t voxel);

} // namespace surgicalmesher
