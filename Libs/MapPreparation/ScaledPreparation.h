// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Preparation of the map for elements of the lengths asked for.

#include "FeatureSimplification.h"
#include "MapChanges.h"
#include "MapPreparation.h"

namespace surgicalmesher
{

struct ScaledPreparationReport
{
  PreparationReport preparation;         ///< of the map as given
  std::set<Label> keptWhole;             ///< tissues too small to simplify
  std::vector<MapChange> simplification; ///< between the map that prepareMap() alone leaves, and the result
};

/// prepareMap(), then simplifyFeatures() and what contacts and islands that leads to. The result is well-composed, and
/// where s(x) is below the voxel spacing, as in all voxels of protected tissues, it is what prepareMap() alone leaves.
/// No tissue disappears. If it throws, the map is as it was.
ScaledPreparationReport prepareAtScale(TissueMap& map, const ScaleField& scale, const PreparationOptions& preparation,
                                       const FeatureOptions& features, const Progress& progress = {});

} // namespace surgicalmesher
