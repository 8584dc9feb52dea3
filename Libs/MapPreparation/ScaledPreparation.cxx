// SPDX-License-Identifier: Apache-2.0
#include "ScaledPreparation.h"

#include "Errors.h"

namespace surgicalmesher
{

ScaledPreparationReport prepareAtScale(TissueMap& map, const ScaleField& scale, const PreparationOptions& preparation,
                                       const FeatureOptions& features, const Progress& progress)
{
  ScaledPreparationReport result;
  if (!(features.featureScale > 0))
  {
    result.preparation = prepareMap(map, preparation, progress);
    return result;
  }
  const PaddedMap prepared = preparedMap(map, featureMargin(map.grid, scale, features.featureScale), preparation,
                                         result.preparation, subProgress(progress, 0, 0.3));
  PaddedMap simplified = prepared;
  result.keptWhole = simplifyFeatures(simplified, scale, features, subProgress(progress, 0.3, 0.8));

  report(progress, 0.8, "Resolving contacts");
  std::set<Label> closed = features.protectedLabels;
  closed.insert(result.keptWhole.begin(), result.keptWhole.end());
  const auto isFixed = [&](std::size_t voxel)
  { return closed.count(prepared.labels[voxel]) > 0 || isBelowScale(prepared, scale, features.featureScale, voxel); };
  prepareAgain(simplified, prepared, preparation, { isFixed, closed });
  if (presentLabels(simplified) != presentLabels(prepared))
    throw EngineError("map preparation: a tissue got lost in simplification");

  report(progress, 0.9, "Listing what changed");
  result.simplification = mapChanges(prepared, simplified);
  report(progress, 1, "Listing what changed");
  copyWithoutMargin(simplified, map);
  return result;
}

} // namespace surgicalmesher
