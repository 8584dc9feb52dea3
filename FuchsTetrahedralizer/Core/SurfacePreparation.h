// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Surfaces without background tetrahedra, made ready to be filled.

#include "SizingFunction.h"
#include "TetMesh.h"

#include <vtkBoundingBox.h>

#include <optional>
#include <string>

namespace surgicalmesher
{

/// The box around all points.
vtkBoundingBox boxAround(const SurfaceComplex& surface);

struct FillableSurface
{
  SurfaceComplex surface;         ///< labelled, closed around every tissue, without edges far longer than L
  std::optional<Label> soleLabel; ///< it was the surface of this tissue alone: its neighbours have become outside
};

/// `surface` ready for tetrahedralizeTissues(): points that coincide are merged; without labels, every closed shell is
/// a tissue (closedShellsToTissues); edges over 1.8 L are divided. `name` stands for it in messages. Throws
/// SurfaceRefused where requireFillable() and closedShellsToTissues() do, and InputError if the surface is smaller than
/// one edge (its coordinates are hardly millimetres) or takes more tetrahedra than fit into the memory available.
FillableSurface fillableSurface(const SurfaceComplex& surface, const SizingFunction& edgeLength,
                                const std::string& name);

} // namespace surgicalmesher
