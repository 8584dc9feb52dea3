// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Smoothing of the boundaries in a map before it is meshed: removes roughness as narrow as the voxels, such as cracks,
/// ears and single steps.
///
/// A voxel at a boundary goes to the face-adjacent label whose indicator, smoothed by a Gaussian, is the largest there,
/// as in one step of threshold dynamics (Merriman, Bence and Osher 1992) for all labels together. A constant is added
/// to the indicator of each label so that all tissues keep their volumes, as in auction dynamics (Jacobs, Merkurjev and
/// Esedoglu 2018): without it, small and thin tissues would shrink. Against the background, part of the indicators of
/// all tissues counts together, so that no groove is dug along the seam of two tissues. Voxels change one by one, and
/// only where every label keeps its topology and its manifold boundary (keepsTopology()).

#include "MapChanges.h"
#include "ScaleField.h"

#include <set>
#include <vector>

namespace surgicalmesher
{

struct LabelSmoothingOptions
{
  /// Standard deviation of the Gaussian along each axis, voxels. Where L is less than `fine` voxels, two thirds of it
  /// are used: for a sigma of up to 1.19, a flat sheet of one voxel then keeps the larger share of its own indicator.
  /// Where L is more than `coarse` voxels, 0.77 of it: single steps hardly affect the triangles there, and more
  /// smoothing would only move the boundary off the map.
  double sigma = 1.19;
  double fine = 1.1;
  double coarse = 3;
  std::set<Label> protectedLabels; ///< keep every voxel and gain none; label 0 protects the background
};

struct SmoothedLabels
{
  TissueMap map;
  std::vector<MapChange> changes; ///< every piece that a label lost or gained
};

/// Smooths a map, which must be well-composed; the result is, too. Deterministic.
SmoothedLabels smoothLabels(const TissueMap& map, const ScaleField& scale, const LabelSmoothingOptions& options);

} // namespace surgicalmesher
