// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which points lie inside a closed surface.

#include "ElementMesh.h"

#include <Eigen/Geometry>

#include <string>

namespace surgicalmesher
{

class InsideTest
{
public:
  /// Throws InputError, naming `name`, unless every edge has an even number of triangles. How they are wound, and
  /// whether they cross, does not matter.
  InsideTest(const TriangleSurface& surface, const std::string& name);

  /// Whether a ray along z leaves the surface an odd number of times. Exact but for points that lie on the surface to
  /// within rounding: an edge is on the same side of a ray for all its triangles.
  bool contains(const Eigen::Vector3d& point) const;

  const Eigen::AlignedBox3d& box() const { return m_Box; }

private:
  std::array<int, 2> bucketOf(const Eigen::Vector3d& point) const;
  /// On which side of the ray through `point` an edge passes; symmetric in the edge's ends.
  bool passesBeyond(const Eigen::Vector3d& point, std::int32_t a, std::int32_t b) const;
  bool isPierced(const Triangle& triangle, const Eigen::Vector3d& point) const;
  double heightAt(const Triangle& triangle, const Eigen::Vector3d& point) const;

  TriangleSurface m_Surface;
  Eigen::AlignedBox3d m_Box;
  int m_Count = 1;                                    ///< buckets along x and along y
  std::vector<std::vector<std::int32_t>> m_Triangles; ///< by bucket
};

/// Volume inside a surface (cubed units of its points), cavities left out, however its triangles are wound.
double volumeInside(const TriangleSurface& surface, const InsideTest& inside);

} // namespace surgicalmesher
