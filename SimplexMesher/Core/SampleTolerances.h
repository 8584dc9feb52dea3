// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How close the mesh has to stay to the boundary of each tissue.

#include "BackgroundMesh.h"
#include "FeatureSimplification.h"
#include "SizingFunction.h"

#include <map>

namespace surgicalmesher
{

/// A distance from the boundary that follows L, mm.
struct Proximity
{
  double near = 0; ///< where L is its least; 0: none is asked for
  double far = 0;  ///< where L is its most
  bool isAsked() const { return near > 0; }
};

struct ToleranceOptions
{
  double maximumDistance = 0; ///< mm; no tolerance is larger; 0: no bound
  FeatureOptions features;    ///< what the map was simplified by
  Proximity proximity;        ///< takes the place of what follows L, between `shortest` and `longest`
  double shortest = 0;        ///< mm
  double longest = 0;         ///< mm
  bool isSmooth = false;      ///< samples will lie on a smooth boundary, not on the voxels' steps
};

/// Gives every sample of `background`, which lies at the centre of a voxel face of `map`, its tolerance:
///
///     min(r max(c voxel + d L, min(e L, 2 voxel)), s thickness), at least 0.6 voxel where thickness decides
///
/// with c = 0.24, d = 0.053 and e = 0.085 for samples of a smooth boundary, 0.42, 0.095 and 0 for others.
/// `thickness`: mean, of each tissue, mm; s = 0.28 + 0.08 F, at most 0.4, with F the feature scale (0 for protected
/// tissues). r is 1, and less, down to 0.5, in large maps with little tissue for each face between tissues. All in the
/// grid frame of the map.
void setTolerances(BackgroundMesh& background, const TissueMap& map, const std::map<Label, double>& thickness,
                   const SizingFunction& length, const ToleranceOptions& options);

} // namespace surgicalmesher
