// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Edge lengths for which triangles stay within a given distance of a curved surface.

#include "SurfaceCurves.h"

namespace surgicalmesher
{

/// Returns, at each point, min(edgeLength, sqrt(6 chordError / k)) in mm, where k is the largest curvature at the
/// point, of the surface or of a curve through the point, measured over a few edges. The centre of an equilateral
/// triangle of that edge length is no farther than `chordError` from the surface. Lengths derived from curvature are
/// not below the surface's own edges, and lengths grow by at most half a mm per mm along the surface.
std::vector<double> lengthsByCurvature(const SurfaceComplex& surface, const std::vector<DualEdge>& sharp,
                                       const std::function<double(const Vec3&)>& edgeLength, double chordError);

} // namespace surgicalmesher
