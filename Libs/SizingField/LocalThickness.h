// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How thick tissues are, at their surface, compared with the edge length asked for.

#include "ScaleField.h"
#include "TissueMap.h"

#include <cstddef>
#include <map>
#include <vector>

namespace surgicalmesher
{

/// A voxel at the surface of its tissue where the tissue is thinner than L.
struct ThinVoxel
{
  std::size_t voxel = 0;
  float thickness = 0; ///< mm
};

struct TissueThickness
{
  double area = 0;     ///< mm^2 of voxel faces at the tissue's surface
  double thinArea = 0; ///< those where the tissue is thinner than L
  double smallest = 0; ///< mm; least thickness where it is, 0 if nowhere
};

struct LocalThickness
{
  std::map<Label, TissueThickness> tissues;
  std::vector<ThinVoxel> thinVoxels; ///< ascending
};

/// Thickness at a voxel is the length of the chord of its tissue along the normal, which the labels of the 5x5x5 voxels
/// around it tell: of a sheet the thickness, of a tube or ball the diameter. Where they tell no direction, and at the
/// rim of a flat piece (at most three voxels along one axis, a fourth of what it is along the others), it is the
/// shortest chord along an axis. Chords are followed up to L. `scale` is in world coordinates. Time grows with the
/// number of voxels at surfaces, whatever the number of tissues.
LocalThickness measureThickness(const TissueMap& map, const ScaleField& scale);

} // namespace surgicalmesher
