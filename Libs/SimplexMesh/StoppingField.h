// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a membrane that grows through a label map has to stop: the surface of some of its tissues, at sub-voxel
/// position, and the map's end.

#include "TissueMap.h"

#include <set>

namespace surgicalmesher
{

class StoppingField
{
public:
  /// Points are in the map's grid frame, mm. Clearances are known up to `mostClearance`.
  StoppingField(const TissueMap& map, const std::set<Label>& stops, double mostClearance);

  /// Whether p is in a stopping tissue or beyond the outer faces of the map's voxels.
  bool stops(const Vec3& p) const;

  /// How far it is from p along the unit vector n to a stopping tissue, mm: negative, and against n, if p is in one.
  /// What is farther than reach() counts as that far.
  double wayToTissue(const Vec3& p, const Vec3& n) const;

  /// The same to the map's end; no limit on the distance.
  double wayToEnd(const Vec3& p, const Vec3& n) const;

  /// From p to the faces of the nearest voxel of a stopping tissue, mm, by the distance to its centre less half a
  /// voxel.
  double clearance(const Vec3& p) const;

  double reach() const { return m_Reach; } ///< two voxels

private:
  double interpolated(const std::vector<float>& values, const Vec3& p) const;
  double share(const Vec3& p) const { return interpolated(m_Share, p); }

  Grid m_Grid;
  std::vector<float> m_Share;     ///< of stopping tissue around each voxel's centre; its surface is where it is a half
  std::vector<float> m_Clearance; ///< at the voxels' centres
  double m_Reach;
};

} // namespace surgicalmesher
