// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Preparation of surfaces without background tetrahedra, so that they can be filled.

#include "SizingFunction.h"
#include "TetMesh.h"

#include <vtkBoundingBox.h>

#include <optional>
#include <string>

namespace surgicalmesher
{

/// Returns the bounding box of all points.
vtkBoundingBox boxAround(const SurfaceComplex& surface);

struct FillableSurface
{
  SurfaceComplex surface; ///< labelled, closed around every tissue, without edges far longer than L
  /// Set if it was the surface of this tissue alone: its neighbours have become outside.
  std::optional<Label> soleLabel;
};

/// Prepares `surface` for tetrahedralizeTissues(): merges coincident points, makes every closed shell a tissue if there
/// are no labels (closedShellsToTissues), and splits edges longer than 1.8 L. `name` identifies the surface in
/// messages. Throws SurfaceRefused as requireFillable() and closedShellsToTissues() do, and InputError if the surface
/// is smaller than one edge (its coordinates are then hardly millimetres) or requires more tetrahedra than fit into the
/// available memory.
FillableSurface fillableSurface(const SurfaceComplex& surface, const SizingFunction& edgeLength,
                                const std::string& name);

} // namespace surgicalmesher
