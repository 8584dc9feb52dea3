// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Point-in-surface test.

#include "ElementMesh.h"

#include <Eigen/Geometry>

#include <string>

namespace surgicalmesher
{

class InsideTest
{
public:
  /// Throws InputError with `name` if an edge has an odd number of triangles. The orientation of the triangles does not
  /// matter, nor whether they intersect.
  InsideTest(const TriangleSurface& surface, const std::string& name);

  /// Whether a ray along z crosses the surface an odd number of times. Exact except for points on the surface to within
  /// rounding: the side on which an edge passes a ray is the same for all its triangles.
  bool contains(const Eigen::Vector3d& point) const;

  const Eigen::AlignedBox3d& box() const { return m_Box; }

private:
  std::array<int, 2> bucketOf(const Eigen::Vector3d& point) const;
  /// Whether an edge crosses the line through `point` along x beyond it; the same for both directions of the edge.
  bool passesBeyond(const Eigen::Vector3d& point, std::int32_t a, std::int32_t b) const;
  bool isPierced(const Triangle& triangle, const Eigen::Vector3d& point) const;
  double heightAt(const Triangle& triangle, const Eigen::Vector3d& point) const;

  TriangleSurface m_Surface;
  Eigen::AlignedBox3d m_Box;
  int m_Count = 1;                                    ///< buckets along x and along y
  std::vector<std::vector<std::int32_t>> m_Triangles; ///< by bucket
};

/// Volume inside a surface, without its cavities, in cubed units of its points; independent of the triangles'
/// orientation.
double volumeInside(const TriangleSurface& surface, const InsideTest& inside);

} // namespace surgicalmesher
