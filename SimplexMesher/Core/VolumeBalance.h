// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Keeps the volume of every tissue: smoothing and least squares cut corners, which takes from whatever is convex.

#include "BackgroundMesh.h"

#include <map>

namespace surgicalmesher
{

class VolumeBalance
{
public:
  /// The volumes to keep are those of `map`.
  explicit VolumeBalance(const TissueMap& map);

  /// Moves the boundary samples of every tissue that has gained or lost volume along its boundary's normals, by what
  /// makes up for the volume and half as much again; half a voxel in all at most, a voxel between two tissues. The mesh
  /// must know its neighbours.
  void apply(BackgroundMesh& background);

private:
  double stepOf(Label label, double lacking);

  double m_Most; ///< mm
  std::map<Label, double> m_Volumes, m_Moved;
};

} // namespace surgicalmesher
