// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Adaptation of the scale to single tissues: to their settings, thickness, curvature and size.

#include "LocalThickness.h"
#include "ScaleField.h"
#include "TissueSettings.h"

#include <map>

namespace surgicalmesher
{

/// Returns `scale` if it is a volume; a scale of one value everywhere (uniformScale()) becomes a volume that covers the
/// map, with twice the spacing of its voxels.
ScaleField scaleVolume(const ScaleField& scale, const Grid& map);

/// Sets the edge length of every shell that has none to the smallest length of `scale` on its voxels.
void completeShells(TissueSettings& settings, const TissueMap& map, const ScaleField& scale);

/// Adapts the scale to the settings of tissues. Within a tissue and on its surface,
///
///     L' = min(max(L, minimum), maximum)
///
/// at all voxels of `scale` that linear interpolation there uses. Where several tissues meet, the largest minimum and
/// the smallest maximum apply, and the maximum prevails; on a shell, only the smallest length of the shells there
/// applies. Around places where L was lowered, it rises by at most `gradation` per mm; 0 sets no limit.
///
/// Returns `scale` itself if no tissue has lengths; otherwise a volume (scaleVolume()).
ScaleField followTissues(const ScaleField& scale, const TissueMap& map, const TissueSettings& settings,
                         double gradation);

/// Adapts the scale to thin tissues: at every thin voxel L' = min(L, max(thickness, smallest voxel spacing)), rising
/// from there by at most `gradation` per mm. Returns a volume (scaleVolume()).
ScaleField followThickness(const ScaleField& scale, const TissueMap& map, const std::vector<ThinVoxel>& thinVoxels,
                           double gradation);

/// A voxel at a curved boundary.
struct CurvedVoxel
{
  std::size_t voxel = 0;
  double curvature = 0; ///< the larger principal curvature, 1/mm
};

/// Adapts the scale to curvature: at every curved voxel L' = min(L, sqrt(8 e / curvature)), so that the middle of an
/// edge stays within the chord error e (mm) of the boundary. L' is not lowered below the scale's own minimum (the
/// smallest voxel spacing, if the scale has one value everywhere), and rises from there by at most `gradation` per mm.
/// Returns a volume (scaleVolume()).
ScaleField followCurvature(const ScaleField& scale, const TissueMap& map, const std::vector<CurvedVoxel>& curvedVoxels,
                           double chordError, double gradation);

/// Returns the mean thickness of each tissue, 2 V / A, mm. A is the area of its voxel faces over 1.5, as their
/// staircase counts as half as large again as a smooth boundary.
std::map<Label, double> meanThickness(const TissueMap& map);

/// Lowers the scale where small tissues need shorter edges to keep their volume; returns `scale` itself if there are
/// none. `thickness`: see meanThickness(). With L the mean over a tissue, and the cube root of its volume as its
/// extent, edges are limited
/// - in tissues that are flatter than near-regular tetrahedra can be (thinner than 0.32 L at an extent above 0.9 L), to
///   twice the thickness;
/// - in tissues that are small in every direction (extent below 0.75 L, where L is more than eight voxels), to 1.33
///   times the extent or eight voxels, whichever is more. A surface of a few longer triangles would stand too far off
///   the samples to enclose the volume.
ScaleField followSmallTissues(const ScaleField& scale, const TissueMap& map, const std::map<Label, double>& thickness);

} // namespace surgicalmesher
