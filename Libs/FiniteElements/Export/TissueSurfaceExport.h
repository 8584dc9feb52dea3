// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closed surface of the mesh and of every tissue, each in a file of its own (.stl, .ply).

#include "Export.h"

namespace surgicalmesher
{

/// For x.stl (binary, single precision) or x.ply (text, double precision), by the file's extension: the outer boundary
/// of the mesh in the file itself, and beside it x.<name of the tissue>.stl or .ply for each tissue, wound outwards.
/// The files say SPACE=LPS, which Slicer understands.
void writeTissueSurfaces(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
