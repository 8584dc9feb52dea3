// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Preparation of the map for elements of the target edge lengths.

#include "FeatureSimplification.h"
#include "MapChanges.h"
#include "MapPreparation.h"

namespace surgicalmesher
{

struct ScaledPreparationReport
{
  PreparationReport preparation;         ///< of the map as given
  std::set<Label> keptWhole;             ///< tissues too small to simplify
  std::vector<MapChange> simplification; ///< from the result of prepareMap() alone to the final map
};

/// Runs prepareMap(), then simplifyFeatures(), and resolves the contacts and removes the islands that it creates. The
/// result is well-composed. Where s(x) is below the voxel spacing, and in all voxels of protected tissues, it equals
/// the result of prepareMap() alone. No tissue disappears. If it throws, the map is as it was.
ScaledPreparationReport prepareAtScale(TissueMap& map, const ScaleField& scale, const PreparationOptions& preparation,
                                       const FeatureOptions& features, const Progress& progress = {});

} // namespace surgicalmesher
