// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Refinement of surfaces that consist of few large triangles, such as those from CAD and STL files, to a target edge
/// length.

#include "SizingFunction.h"
#include "TetMesh.h"

namespace surgicalmesher
{

/// Splits edges longer than 1.8 times their target length at their midpoints, with all their triangles. The relatively
/// longest edges come first; before an edge is split, so are the longer sides of its triangles (longest-edge bisection
/// and its propagation: Rivara, Int. J. Numer. Meth. Eng. 20(4), 1984). New points lie on the edges, so that the shape
/// with its flat faces, sharp edges and corners is preserved exactly. Labels are inherited, and existing points keep
/// their ids. Lengths in mm.
SurfaceComplex withDividedEdges(const SurfaceComplex& surface, const SizingFunction& edgeLength);

} // namespace surgicalmesher
