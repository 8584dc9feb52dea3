// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Simplification of the tissue map at the scale of the mesh.
///
/// Detail much smaller than the elements costs many elements and means little: far from the target, islands, cavities,
/// tunnels, handles and necks smaller than s(x) = F L(x) are removed, where L is the target edge length. There are two
/// local rules:
/// - a region (an island of a tissue, a pocket of background) of a volume below s^3 goes to the labels around it;
/// - a voxel whose label fills too small a share of the ball of diameter s around it goes to the face-adjacent label
///   that fills the most. At a flat boundary, a voxel's own label fills half of the ball; at the surface of a long
///   strand of thickness s, two fifths. So strands, thin walls and narrow passages give way, and flat or gently rounded
///   boundaries stay in place. A compact piece keeps its surface if it is larger than about 1.5 s.
/// The second rule is threshold dynamics (Merriman, Bence and Osher 1992) with a margin: without the margin, every
/// round would move every boundary that is not flat. It takes as many rounds as s has voxels; a last search for small
/// regions follows. A narrow passage through a wall that is itself thin can remain.

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

/// Returns the margin, in voxels, that simplifyFeatures() needs, as its largest ball reaches beyond the map's border.
int featureMargin(const Grid& grid, const ScaleField& scale, double featureScale);

/// Simplifies the map, which must have a margin of featureMargin(). A voxel changes only where s(x) is at least the
/// smallest voxel spacing; s above 16 times that spacing counts as 16 times. No tissue disappears: a tissue that would
/// lose more than half of its voxels is left as if protected. Returns these tissues. Deterministic. The map may have
/// new diagonal contacts afterwards. If `progress` throws, the map is as it was.
std::set<Label> simplifyFeatures(PaddedMap& map, const ScaleField& scale, const FeatureOptions& options,
                                 const Progress& progress = {});

/// Whether s(x) is below the smallest voxel spacing at the voxel with that memory index.
bool isBelowScale(const PaddedMap& map, const ScaleField& scale, double featureScale, std::size_t voxel);

} // namespace surgicalmesher
