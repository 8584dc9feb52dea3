// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Roughness of a map, as narrow as its voxels, taken away before anything is meshed: cracks, ears and single steps.
///
/// A voxel at a boundary goes to the label beside it whose indicator, smoothed by a Gaussian, is the largest there, as
/// in one step of threshold dynamics (Merriman, Bence and Osher 1992) for all labels together. To every indicator a
/// constant of its label is added with which all tissues keep their volumes, as in auction dynamics (Jacobs, Merkurjev
/// and Esedoglu 2018): without it small and thin ones would shrink. Against the background tissues stand together, in
/// part, so that no groove is dug along the seam of two of them. Voxels change one by one, and only where every label
/// keeps its topology and its manifold boundary (keepsTopology()).

#include "MapChanges.h"
#include "ScaleField.h"

#include <set>
#include <vector>

namespace surgicalmesher
{

struct LabelSmoothingOptions
{
  /// Standard deviation of the Gaussian along each axis, voxels. Where L is less than `fine` voxels two thirds of it: up
  /// to 1.19, that leaves a flat sheet of one voxel the larger share of its own indicator. Where L is more than `coarse`
  /// 0.77 of it: triangles there hardly feel single steps, and to take more only takes the boundary off the map.
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

/// `map` is well-composed, and so is the result. Deterministic.
SmoothedLabels smoothLabels(const TissueMap& map, const ScaleField& scale, const LabelSmoothingOptions& options);

} // namespace surgicalmesher
