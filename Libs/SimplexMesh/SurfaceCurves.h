// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The curves of a surface complex: edges where three or more interfaces meet, and sharp edges within an interface.

#include "SimplexOperators.h"

#include <optional>

namespace surgicalmesher
{

/// Returns the sharp edges of the surface, ascending: edges between two triangles whose normals differ by more than
/// `angle` degrees, both directly and in the mean over all triangles within L(x) on either side, where both sides are
/// smooth. This selects edges that are sharp at the scale of the target length, such as those of a cube, and not the
/// steps of voxels. Edges that continue the curves beyond their ends, as before a corner, are included; pieces shorter
/// than 2 L are omitted.
std::vector<DualEdge> sharpEdges(const SurfaceComplex& surface, double angle,
                                 const std::function<double(const Vec3&)>& edgeLength);

class SurfaceCurves
{
public:
  SurfaceCurves(const SurfaceComplex& surface, const std::vector<DualEdge>& sharp);

  /// Returns the point nearest to p on the curves between exactly these labels (ascending), or nothing if none is
  /// within `reach` mm.
  std::optional<Vec3> nearest(const Vec3& p, const std::vector<Label>& labels, double reach) const;

  /// Returns the curvature of the curve at each point, 1/mm; negative off curves, at their ends and where several meet.
  std::vector<double> curvatures() const;

private:
  struct Segment
  {
    DualEdge ends;
    std::vector<Label> labels; ///< of the triangles at the segment, ascending
  };

  std::vector<Vec3> m_Points;
  std::vector<Segment> m_Segments;
  BoxGrid m_Grid;
};

/// Returns the labels on either side of the triangles, each once, ascending.
std::vector<Label> labelsOf(const std::vector<std::array<Label, 2>>& sides);

} // namespace surgicalmesher
