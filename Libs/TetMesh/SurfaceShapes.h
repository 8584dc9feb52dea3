// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Closed surfaces made in code. Tissue `inside` is behind their normals, `outside` in front.

#include "TetMesh.h"

namespace surgicalmesher
{

/// An octahedron, each triangle split into four `levels` times, its points on a sphere: 8 * 4^levels triangles.
SurfaceComplex sphere(const Vec3& centre, double radius, int levels, Label inside = 1, Label outside = 0);

/// Adds the triangles of `other` with points of their own.
void append(SurfaceComplex& surface, const SurfaceComplex& other);

} // namespace surgicalmesher
