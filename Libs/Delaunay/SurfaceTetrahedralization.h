// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Labelled tetrahedra from a surface complex, by constrained Delaunay tetrahedralization (TetGen).

#include "BccLattice.h"
#include "SurfaceRefused.h"
#include "VertexPlacement.h"

namespace surgicalmesher
{

/// Returns the tetrahedra of all tissues and of the space around them (label 0) up to the convex hull of all points: an
/// ambient complex, ready for improvement. Its label interfaces are exactly the triangles of `surface`. The points of
/// `surface` come first and in the same order; then follow the lattice points (see latticePoints), and the few points
/// that had to be added off the triangles, to recover them and to give flat tetrahedra a volume. Labels follow from the
/// label pairs of the surface alone: each region between triangles gets the label that its triangles have on that side.
/// The quality is that of a Delaunay tetrahedralization, slivers included. The mesh is positively oriented and
/// face-to-face, without unused points, and deterministic.
///
/// `surface` must have passed requireFillable(). `name` identifies the surface in messages. Throws SurfaceRefused, with
/// the position, if the triangles around a region disagree on its label, and EngineError if TetGen fails. Where the
/// platform supports it, TetGen runs in a process of its own, so that its failed assertions and crashes also end as
/// EngineError.
TetMesh tetrahedralize(const SurfaceComplex& surface, const std::vector<Vec3>& latticePoints, const std::string& name);

/// The same with the lattice points of `edgeLength`, adjusted according to `placement`. If TetGen fails, which rare
/// coincidences of points can cause, it is retried with lattice points farther away from the surface before EngineError
/// is thrown.
TetMesh fillWithTetrahedra(const SurfaceComplex& surface, const SizingFunction& edgeLength, const std::string& name,
                           VertexPlacement placement = VertexPlacement::Lattice);

} // namespace surgicalmesher
