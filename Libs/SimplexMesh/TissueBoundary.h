// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the boundary between two tissues is, at sub-voxel position: what attracts the simplex mesh.

#include "BoxGrid.h"
#include "TetMesh.h"

#include <optional>

namespace surgicalmesher
{

struct TissueMap;

/// Nearest point of a boundary.
struct BoundaryPoint
{
  Vec3 position;
  Vec3 normal; ///< unit; out of the first of the two tissues that were asked for
  double distance = 0;
};

/// The dense surface of a map's tissues: the voxels' staircase, smoothed without shrinking (ReferenceSurface.h), two
/// triangles or more per voxel face. `map` is to be well-composed (prepareMap); points in its grid frame, mm.
SurfaceComplex smoothedBoundary(const TissueMap& map);

class TissueBoundary
{
public:
  /// `surface` may be smoothedBoundary() or any other; distances over `reach` mm count as none.
  TissueBoundary(const SurfaceComplex& surface, double reach);

  /// The point nearest to p of the faces between these two tissues; none within reach, no answer.
  std::optional<BoundaryPoint> nearest(const Vec3& p, const std::array<Label, 2>& tissues) const;

  double reach() const { return m_Reach; }

  /// Hands over the centroids, and the labels, of the surface's triangles near the box, some of them several times,
  /// until `visit` returns false.
  template <class Visit>
  void samples(const Box& box, const Visit& visit) const
  {
    m_Grid.visit(box, [&](std::int32_t t) { return visit(m_Centroids[t], m_Surface.labels[t]); });
  }

  /// Likewise those in the box, each once for each labels, and the triangles' corners and the middles of their edges.
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
  std::vector<double> m_Radii; ///< of the triangles, around their centroids
  double m_Reach, m_Cell;
  BoxGrid m_Grid, m_SampleGrid;
};

/// Nearest point of triangle abc to p.
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace surgicalmesher
