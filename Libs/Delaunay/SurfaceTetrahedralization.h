// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From a surface complex to labelled tetrahedra, by constrained Delaunay (TetGen).

#include "BccLattice.h"
#include "SurfaceRefused.h"
#include "VertexPlacement.h"

namespace surgicalmesher
{

/// Tetrahedra of all tissues and of the space around them (label 0), out to the convex hull of all points: an ambient
/// complex, ready for improvement. Their label interfaces are exactly the triangles of `surface`, whose points come
/// first and in the same order; then follow the lattice points (see latticePoints), and the few that had to be added
/// away from the triangles, to respect them and to give flat tetrahedra a volume. Labels come from the surface's label
/// pairs alone: each region between triangles takes the label its triangles have on that side. The quality is that of a
/// Delaunay tetrahedralization, slivers included. Positively wound, face-to-face, every point used, deterministic.
///
/// `surface` must have passed requireFillable(). Throws SurfaceRefused, with `name` and the place, if the triangles
/// around a region don't agree on its label, EngineError if TetGen fails. TetGen runs in a process of its own where
/// there are such: its failed assertions and crashes are failures like others.
TetMesh tetrahedralize(const SurfaceComplex& surface, const std::vector<Vec3>& latticePoints, const std::string& name);

/// The same with the lattice points of `edgeLength`, adjusted as `placement` says. TetGen stumbles over rare coincidences of points; it is then given
/// others, farther away from the surface, before EngineError is thrown.
TetMesh fillWithTetrahedra(const SurfaceComplex& surface, const SizingFunction& edgeLength, const std::string& name,
                           VertexPlacement placement = VertexPlacement::Lattice);

} // namespace surgicalmesher
