// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files in and out: label maps, scale volumes, tissue tables, markups. All throw InputError with the file's name, what
/// was found and what was expected. Writers write the file as named: atomic replacement is the caller's (CommandLine).

#include "Distance.h"
#include "ScalarImage.h"
#include "ScaleField.h"
#include "TissueMap.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Reads NRRD, .seg.nrrd, NIfTI, Analyze, MetaImage and GIPL. The axes are brought to LPS order (see TissueMap::grid).
/// A NIfTI file lies where its sform says, or its qform if it has no sform of perpendicular axes. Segmentations: names
/// and colours come from the header; several layers become one map, in which the later segment wins where two overlap,
/// and labels are the header's values unless two layers share one: then 1, 2, 3 ... in the header's order. A segment's
/// tag says whether it is null displacement, as writeTissueMap has it. Floating-point values within 1e-4 of a label are
/// that label, as resampling and arithmetic leave them. Refused: missing file, directory, truncated data, more than
/// three dimensions (a fourth of size 1 is dropped), several components, non-integers, negative labels, labels over
/// 65535, no voxel but background, more than 2^31 voxels, spacing that is not positive, axes that are not finite and
/// perpendicular.
TissueMap readTissueMap(const std::string& file);

/// Writes a compressed NRRD (or what the extension says) in the frame of map.grid. An NRRD carries map.table as
/// Slicer's segmentations do, and which tissues are null displacement as tags of theirs.
void writeTissueMap(const TissueMap& map, const std::string& file);

/// Reads any of the same formats; every value has to be finite and positive.
ScaleField readScale(const std::string& file);
void writeScale(const ScaleField& scale, const std::string& file);

/// Reads any of the same formats, one value per voxel; every value has to be finite.
ScalarImage readImage(const std::string& file);
void writeImage(const ScalarImage& image, const std::string& file);

/// Throws InputError if the volume of `scale` (voxel centres plus half a voxel) leaves out part of `grid`.
void requireCover(const ScaleField& scale, const Grid& grid, const std::string& scaleFile);

/// Names and colours from a Slicer colour table (.ctbl, .txt, .csv), an ITK-SNAP label file, a BIDS look-up table
/// (.tsv), FSL's description of an atlas (.xml) or an atlas's list of labels and names. Background (label 0) is left
/// out; underscores in names become blanks again. Where a label comes twice, the last counts, and `warnings` says so.
TissueTable readTissueTable(const std::string& file, std::vector<std::string>* warnings = nullptr);

/// Adds the names and colours of a table file (none if `file` is empty) to the map's own, and forgets those of tissues
/// that the map doesn't have. Null-displacement tissue keeps its name: an atlas may have another tissue of its label;
/// and no name makes a tissue null displacement. All names are legible afterwards (TextFile.h).
void completeTissueTable(TissueMap& map, const std::string& file, std::vector<std::string>* warnings = nullptr);

/// Whether the format of `file`, by its extension, keeps what writeTissueMap says of the tissues.
bool keepsTissues(const std::string& file);

/// The label that `text` means: a number from 0 to 65535, or a name of `names` (underscores and blanks are the same).
/// Returns false if it is neither, and for a name that several tissues have.
bool findTissue(const std::string& text, const TissueTable& names, Label& label);

/// For messages, why findTissue() finds none: that `text` is neither a label nor a name, or which tissues have the name.
std::string whyNoTissue(const std::string& text, const TissueTable& names);

/// Control points of every markup in a .mrk.json (Fiducial, Curve, ClosedCurve, Line) or .fcsv file, in LPS mm,
/// whatever the file's own coordinate system; a ClosedCurve ends with its first point again. One list per markup that
/// has points; points that are not placed (positionStatus) are left out. Refused: no point at all, coordinates that are
/// no finite numbers, another unit than mm.
std::vector<std::vector<Vec3>> readMarkups(const std::string& file);

/// Targets and paths as the command-line modules take them: typed points, of which those of --pathPoint are one path,
/// and markups files. Every point of a target file is a target, every markup of a path file a path. Throws UsageError
/// for a typed path of one point or of no length, InputError for one of a file.
Focus readFocus(const std::vector<Vec3>& targetPoints, const std::vector<std::string>& targetFiles,
                const Path& pathPoints, const std::vector<std::string>& pathFiles);

/// A plane or a box (ROI) of Slicer.
struct MarkupRegion
{
  Vec3 center;              ///< LPS, mm
  std::array<Vec3, 3> axes; ///< of unit length, LPS; the third is a plane's normal
  Vec3 size;                ///< of a box along its axes (mm)
};

/// One markup with what its control points carry besides their places.
struct Markup
{
  std::vector<Vec3> points;                               ///< LPS, mm
  std::vector<std::string> labels;                        ///< by point; empty where it has none
  std::map<std::string, std::vector<double>> pointValues; ///< measurements of one value a point, by name
  std::string type;                                       ///< Slicer's word: "Fiducial", "Plane"; empty in .fcsv
  std::optional<MarkupRegion> region;                     ///< of types "Plane" and "ROI" that have one
};

/// The same markups as readMarkups(), with labels and measurements. A measurement whose values are not as many as the
/// points, or no finite numbers, is left out.
std::vector<Markup> readLabelledMarkups(const std::string& file);

} // namespace surgicalmesher
