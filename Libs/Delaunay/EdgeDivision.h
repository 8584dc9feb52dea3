// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Surfaces of few large triangles, as CAD and STL files have them, at the scale that is asked for.

#include "SizingFunction.h"
#include "TetMesh.h"

namespace surgicalmesher
{

/// Halves edges that are longer than 1.8 times the length wanted at their midpoints, with all their triangles, the
/// relatively longest first, after the longer sides of their triangles (longest-edge bisection and its propagation:
/// Rivara, Int. J. Numer. Meth. Eng. 20(4), 1984). New points lie on
/// the edges, so that the shape, its flat faces, sharp edges and corners stay exactly as they are; labels are
/// inherited. The points there were keep their ids. Lengths in mm.
SurfaceComplex withDividedEdges(const SurfaceComplex& surface, const SizingFunction& edgeLength);

} // namespace surgicalmesher
