// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Surfaces and meshes that lie in a template, taken along with it.

#include "ElementMesh.h"

namespace surgicalmesher
{

/// Where points beside or within a template go when its nodes go from `from` to `to`: a thin-plate spline of at most
/// `centres` nodes, evenly chosen (the paper's section 3.1, third step), and what it leaves of the displacement of the
/// nodes next to a point, by inverse distance.
Points carried(const Points& points, const Points& from, const Points& to, int centres = 1000);

} // namespace surgicalmesher
