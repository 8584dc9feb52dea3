// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Location of the boundary between two tissues, at sub-voxel position: the target of the image forces on the simplex
/// mesh.

#include "BoxGrid.h"
#include "TetMesh.h"

#include <optional>

namespace surgicalmesher
{

struct TissueMap;

/// The point of a boundary that is nearest to a query point.
struct BoundaryPoint
{
  Vec3 position;
  Vec3 normal; ///< unit; points out of the first of the two tissues of the query
  double distance = 0;
};

/// Returns the dense surface of the tissues of a map: the staircase of the voxel faces, smoothed without shrinking
/// (ReferenceSurface.h), with two or more triangles per voxel face. `map` must be well-composed (prepareMap); points
/// are in its grid frame, mm.
SurfaceComplex smoothedBoundary(const TissueMap& map);

class TissueBoundary
{
public:
  /// `surface` may be smoothedBoundary() or any other; boundaries farther than `reach` mm from a query are ignored.
  TissueBoundary(const SurfaceComplex& surface, double reach);

  /// Returns the point nearest to p on the boundary between these two tissues, or nothing if none is within reach.
  std::optional<BoundaryPoint> nearest(const Vec3& p, const std::array<Label, 2>& tissues) const;

  double reach() const { return m_Reach; }

  /// Calls visit(centroid, labels) for the triangles of the surface near the box, until it returns false. A triangle
  /// may come several times.
  template <class Visit>
  void samples(const Box& box, const Visit& visit) const
  {
    m_Grid.visit(box, [&](std::int32_t t) { return visit(m_Centroids[t], m_Surface.labels[t]); });
  }

  /// Calls visit(point, labels) for the centroids, corners and edge midpoints of the triangles that lie in the box,
  /// each once per pair of labels, until it returns false.
  template <class Visit>
  void allSamples(const Box& box, const Visit& visit) const
  {
    m_SampleGrid.visit(box, [&](std::int32_t s)
                       { return !box.contains(m_Samples[s].p) || visit(m_Samples[s].p, m_Samples[s].labels); });
  }

private:
  struct Sample
  {
    Vec3 p;
    std::array<Label, 2> labels;
  };

  void addSamples();

  SurfaceComplex m_Surface;
  std::vector<Sample> m_Samples;
  std::vector<Vec3> m_Centroids;
  std::vector<double> m_Radii; ///< radii of the triangles around their centroids
  double m_Reach, m_Cell;
  BoxGrid m_Grid, m_SampleGrid;
};

/// Returns the point of triangle abc that is nearest to p.
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace surgicalmesher
