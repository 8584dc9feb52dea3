#pragma once
/// The closed surface of every tissue, in a file of its own.

#include "Export.h"

namespace surgicalmesher
{

/// For x.stl (binary) or x.ply (binary), by the file's extension, writes x.<name of the tissue>.stl or .ply for each tissue,
/// wound outwards; the file x.stl itself is not written. Coordinates become single precision, as both writers of VTK have
/// it. The files say SPACE=LPS, which Slicer understands.
void writeTissueSurfaces(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
