// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Edge lengths by which triangles stay within a distance of a curved surface.

#include "SurfaceCurves.h"

namespace surgicalmesher
{

/// At each point, min(edgeLength, sqrt(6 chordError / k)) with k the largest curvature there, of the surface or of a
/// curve through the point, measured over a few edges: equilateral triangles of that length leave no more than the
/// chord error between their middle and the surface. Not below the surface's own edges, and rising by no more than half
/// a mm per mm along the surface.
std::vector<double> lengthsByCurvature(const SurfaceComplex& surface, const std::vector<DualEdge>& sharp,
                                       const std::function<double(const Vec3&)>& edgeLength, double chordError);

} // namespace surgicalmesher
