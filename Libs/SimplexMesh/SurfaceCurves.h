// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The curves of a surface complex: where three or more sheets meet, and sharp edges within a sheet.

#include "SimplexOperators.h"

#include <optional>

namespace surgicalmesher
{

/// Edges of two triangles whose normals are more than `angle` degrees apart, and stay so in the mean over all that lies
/// within L(x) on either side, both of them smooth: what is sharp at the scale of the edges to come, such as a cube's
/// edges, and not the steps of voxels. With what goes on from their ends, as before a corner; pieces shorter than twice
/// L are left out. Ascending.
std::vector<DualEdge> sharpEdges(const SurfaceComplex& surface, double angle,
                                 const std::function<double(const Vec3&)>& edgeLength);

class SurfaceCurves
{
public:
  SurfaceCurves(const SurfaceComplex& surface, const std::vector<DualEdge>& sharp);

  /// The point nearest to p on the curves between exactly these labels, ascending; none within reach, no answer.
  std::optional<Vec3> nearest(const Vec3& p, const std::vector<Label>& labels, double reach) const;

  /// By point, the curvature of the curve there, 1/mm; negative off curves and where several meet.
  std::vector<double> curvatures() const;

private:
  struct Segment
  {
    DualEdge ends;
    std::vector<Label> labels; ///< of the triangles there, ascending
  };

  std::vector<Vec3> m_Points;
  std::vector<Segment> m_Segments;
  BoxGrid m_Grid;
};

/// Labels on either side of the triangles, each once, ascending.
std::vector<Label> labelsOf(const std::vector<std::array<Label, 2>>& sides);

} // namespace surgicalmesher
