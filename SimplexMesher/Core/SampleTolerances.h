// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tolerances: how close the mesh has to stay to the boundary of each tissue.

#include "BackgroundMesh.h"
#include "FeatureSimplification.h"
#include "SizingFunction.h"

#include <map>

namespace surgicalmesher
{

/// A distance from the boundary, mm, that varies linearly with L.
struct Proximity
{
  double near = 0; ///< where L is smallest; 0: not requested
  double far = 0;  ///< where L is largest
  bool isAsked() const { return near > 0; }
};

struct ToleranceOptions
{
  double maximumDistance = 0; ///< upper bound of all tolerances, mm; 0: none
  FeatureOptions features;    ///< options by which the map was simplified
  Proximity proximity;        ///< replaces the tolerances that follow L; reached at `shortest` and `longest`
  double shortest = 0;        ///< smallest L, mm
  double longest = 0;         ///< largest L, mm
  bool isSmooth = false;      ///< samples will lie on a smooth boundary instead of the steps of voxels
};

/// Sets the tolerance of every sample of `background`, each of which lies at the centre of a voxel face of `map`:
///
///     min(r max(c voxel + d L, min(e L, 2 voxel)), s thickness), at least 0.6 voxel where thickness decides
///
/// with c = 0.24, d = 0.053 and e = 0.085 for samples of a smooth boundary, and 0.42, 0.095 and 0 for others.
/// `thickness` is the mean thickness of each tissue, mm; s = 0.28 + 0.08 F, at most 0.4, where F is the feature scale
/// (0 for protected tissues). r is 1; in large maps with little tissue per face between tissues it is less, down to
/// 0.5. All coordinates are in the grid frame of the map.
void setTolerances(BackgroundMesh& background, const TissueMap& map, const std::map<Label, double>& thickness,
                   const SizingFunction& length, const ToleranceOptions& options);

} // namespace surgicalmesher
