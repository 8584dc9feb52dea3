// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closed surface of the mesh and of every tissue, each in a file of its own (.stl, .ply).

#include "Export.h"

namespace surgicalmesher
{

/// Writes the outer boundary of the mesh to `file`, x.stl (binary, single precision) or x.ply (text, double precision)
/// by its extension, and the surface of each tissue to x.<name of the tissue>.stl or .ply beside it, oriented outwards.
/// The files contain SPACE=LPS, which Slicer understands.
void writeTissueSurfaces(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
