// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Edge lengths that single tissues ask for, brought into the scale.

#include "LocalThickness.h"
#include "ScaleField.h"
#include "TissueSettings.h"

#include <map>

namespace surgicalmesher
{

/// `scale` if it covers the map; a scale of one value everywhere (uniformScale) becomes a volume of two voxels'
/// spacing.
ScaleField scaleVolume(const ScaleField& scale, const Grid& map);

/// Gives every shell without an edge length the smallest that `scale` has on it.
void completeShells(TissueSettings& settings, const TissueMap& map, const ScaleField& scale);

/// The scale that follows the settings: within a tissue and on its surface,
///
///     L' = min(max(L, minimum), maximum)
///
/// on all voxels of `scale` that linear interpolation there refers to. Where several tissues meet, the largest minimum
/// and the smallest maximum count, the maximum first; on a shell, the smallest length of shells counts alone. Around
/// places where L was lowered it rises by at most `gradation` per mm; 0 sets no limit.
///
/// Without a tissue that has lengths, `scale` itself; otherwise a volume (scaleVolume).
ScaleField followTissues(const ScaleField& scale, const TissueMap& map, const TissueSettings& settings,
                         double gradation);

/// The scale that follows thin tissues: at every thin voxel L' = min(L, max(thickness, smallest voxel spacing)), rising
/// from there by at most `gradation` per mm. A volume (scaleVolume).
ScaleField followThickness(const ScaleField& scale, const TissueMap& map, const std::vector<ThinVoxel>& thinVoxels,
                           double gradation);

/// A voxel at a curved boundary.
struct CurvedVoxel
{
  std::size_t voxel = 0;
  double curvature = 0; ///< the larger principal one, 1/mm
};

/// The scale that follows curvature: at every curved voxel L' = min(L, sqrt(8 e / curvature)), by which the middle of an
/// edge stays within the chord error e (mm) of the boundary; not below the scale's own minimum (the smallest voxel
/// spacing, if it has one value everywhere), rising from there by at most `gradation` per mm. A volume (scaleVolume).
ScaleField followCurvature(const ScaleField& scale, const TissueMap& map, const std::vector<CurvedVoxel>& curvedVoxels,
                           double chordError, double gradation);

/// Mean thickness of each tissue but the background, 2 V / A, mm. The staircase of voxel faces counts as half as large
/// again as a smooth boundary.
std::map<Label, double> meanThickness(const TissueMap& map);

/// The scale that small tissues need to keep their volume; `scale` itself if there are none. Of each the mean L counts,
/// and its extent, the cube root of its volume:
/// - flatter than near-regular tetrahedra can be, thinner (as of meanThickness) than 0.32 L at an extent above 0.9 L:
///   at most twice its thickness;
/// - small all round, of an extent below 0.75 L where L is more than eight voxels: at most 1.33 times its extent, but
///   eight voxels are enough. A few triangles that long would stand too far off the samples to hold the volume.
ScaleField followSmallTissues(const ScaleField& scale, const TissueMap& map, const std::map<Label, double>& thickness);

} // namespace surgicalmesher
