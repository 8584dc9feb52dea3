// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a membrane that grows through a label map has to stop: at the surface of some of its tissues, at sub-voxel
/// position, and at the end of the map.

#include "TissueMap.h"

#include <set>

namespace surgicalmesher
{

class StoppingField
{
public:
  /// Points are in the grid frame of the map, mm. Clearances are capped at `mostClearance`, mm.
  StoppingField(const TissueMap& map, const std::set<Label>& stops, double mostClearance);

  /// Returns whether p is in a stopping tissue or beyond the outer faces of the map's voxels.
  bool stops(const Vec3& p) const;

  /// Returns the distance, mm, from p along the unit vector n to the surface of a stopping tissue. If p is in such a
  /// tissue, the distance is measured along -n and returned negative. Its magnitude is at most reach().
  double wayToTissue(const Vec3& p, const Vec3& n) const;

  /// Returns the distance from p along n to the end of the map, mm, without an upper limit.
  double wayToEnd(const Vec3& p, const Vec3& n) const;

  /// Returns the distance from p to the faces of the nearest voxel of a stopping tissue, mm, approximated as the
  /// distance to the centre of that voxel minus half a voxel.
  double clearance(const Vec3& p) const;

  double reach() const { return m_Reach; } ///< two voxels (of the smallest spacing), mm

private:
  double interpolated(const std::vector<float>& values, const Vec3& p) const;
  double share(const Vec3& p) const { return interpolated(m_Share, p); }

  Grid m_Grid;
  std::vector<float> m_Share;     ///< of stopping tissue around each voxel's centre; the surface is at 0.5
  std::vector<float> m_Clearance; ///< at the voxels' centres
  double m_Reach;
};

} // namespace surgicalmesher
