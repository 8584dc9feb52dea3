// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Thickness of tissues at their surface, compared with the target edge length L.

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
  double thinArea = 0; ///< mm^2, the part of it where the tissue is thinner than L
  double smallest = 0; ///< mm; least thickness on that part, 0 if there is none
};

struct LocalThickness
{
  std::map<Label, TissueThickness> tissues;
  std::vector<ThinVoxel> thinVoxels; ///< ascending
};

/// Measures the thickness at every voxel on a tissue's surface: the length of the chord through the tissue along the
/// normal, which is estimated from the labels of the 5x5x5 voxels around. This is the thickness of a sheet and the
/// diameter of a tube or ball. Where these labels give no direction, it is the shortest chord along an axis; at the rim
/// of a flat piece (at most three voxels along one axis, a quarter of its extent along the others), the shorter of the
/// two. Chords are followed up to L. `scale` is in world coordinates. Time grows with the number of surface voxels,
/// whatever the number of tissues.
LocalThickness measureThickness(const TissueMap& map, const ScaleField& scale);

} // namespace surgicalmesher
