#pragma once
/// Files in and out: label maps, scale volumes, tissue tables, markups. All throw InputError with the file's name, what
/// was found and what was expected. Writers write the file as named: atomic replacement is the caller's (CommandLine).

#include "ScaleField.h"
#include "TissueMap.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Reads NRRD, .seg.nrrd (shared-label layers; names and colours from its header), NIfTI, MetaImage and whatever else ITK
/// reads. The axes are brought to LPS order (see TissueMap::grid). Refused: missing file, directory, truncated data,
/// more than three dimensions, several components, non-integers, negative labels, labels over 65535, no voxel but background.
TissueMap readTissueMap(const std::string& file);

/// Writes a compressed NRRD (or what the extension says) in the frame of map.grid.
void writeTissueMap(const TissueMap& map, const std::string& file);

ScaleField readScale(const std::string& file);
void writeScale(const ScaleField& scale, const std::string& file);

/// Throws InputError if the volume of `scale` (voxel centres plus half a voxel) leaves out part of `grid`.
void requireCover(const ScaleField& scale, const Grid& grid, const std::string& scaleFile);

/// Names and colours from a Slicer colour table (.ctbl, .txt) or an ITK-SNAP label file.
TissueTable readTissueTable(const std::string& file);

/// Control points of every markup in a .mrk.json (Fiducial, Curve, ClosedCurve, Line) or .fcsv file, in LPS mm, whatever
/// the file's own coordinate system; a ClosedCurve ends with its first point again. One list per markup.
std::vector<std::vector<Vec3>> readMarkups(const std::string& file);

} // namespace surgicalmesher
