#pragma once
/// The closed surface of every tissue, in a file of its own.

#include "Export.h"

namespace surgicalmesher
{

/// For x.stl (binary, single precision) or x.ply (text, double precision), by the file's extension, writes
/// x.<name of the tissue>.stl or .ply for each tissue, wound outwards; the file x.stl itself is not written. The files say
/// SPACE=LPS, which Slicer understands.
void writeTissueSurfaces(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
