// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Deformation of surfaces and meshes along with a template in which they lie.

#include "ElementMesh.h"

namespace surgicalmesher
{

/// Moves points on, near or within a template as its nodes move from `from` to `to` (a column per node): by a
/// thin-plate spline of at most `centres` evenly chosen nodes (the paper's section 3.1, third step), plus what the
/// spline misses of the displacement of nearby nodes, weighted by inverse squared distance.
Points carried(const Points& points, const Points& from, const Points& to, int centres = 1000);

} // namespace surgicalmesher
