// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reading and writing of label maps, scale volumes, tissue tables and markups. All functions throw InputError with the
/// file's name, what was found and what was expected. Writers write directly to the given name: atomic replacement is
/// up to the caller (CommandLine).

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

/// Reads NRRD, .seg.nrrd, NIfTI, MetaImage and GIPL. The axes are brought to LPS order (see TissueMap::grid). Lengths
/// in cm, m or micrometres, by the header, become mm. A NIfTI file is placed by its sform, or by its qform if it has no
/// sform of perpendicular axes. Segmentations: names and colours come from the header; several layers become one map,
/// in which the later segment wins where two overlap, and labels are the header's values unless two layers share one:
/// then 1, 2, 3 ... in the header's order. A segment's tag, as written by writeTissueMap(), marks null displacement.
/// Floating-point values within 1e-4 of a label count as that label, since resampling and arithmetic produce such
/// values. Refused: missing file, directory, truncated data, more than three dimensions (a fourth of size 1 is
/// dropped), several components, non-integers, negative labels, labels over 65535, no voxel but background, more than
/// 2^31 voxels, spacing that is not positive, axes that are not finite and perpendicular.
TissueMap readTissueMap(const std::string& file);

/// Writes a compressed NRRD, or the format of the extension, in the frame of map.grid. An NRRD contains map.table in
/// the form of Slicer's segmentations, with a tag on null-displacement tissues.
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
/// out; underscores in names become blanks again. If a label occurs twice, the last row counts; if the names differ,
/// `warnings` says so.
TissueTable readTissueTable(const std::string& file, std::vector<std::string>* warnings = nullptr);

/// Adds the names and colours of a table file (none if `file` is empty) to map.table, and removes the entries of
/// tissues that the map does not have. Null-displacement tissue keeps its name, since an atlas may use its label for
/// another tissue; no name makes a tissue null displacement. Afterwards all names are legible (Text.h).
void completeTissueTable(TissueMap& map, const std::string& file, std::vector<std::string>* warnings = nullptr);

/// Whether the format of `file`, by its extension, stores the table of tissues (see writeTissueMap()).
bool keepsTissues(const std::string& file);

/// Finds the label that `text` means: a number from 0 to 65535, or a name in `names` (underscores and blanks are
/// equivalent). Returns false if `text` is neither, or a name that several tissues have.
bool findTissue(const std::string& text, const TissueTable& names, Label& label);

/// Returns, for messages, why findTissue() fails: that `text` is neither a label nor a name, or which tissues share the
/// name.
std::string whyNoTissue(const std::string& text, const TissueTable& names);

/// Returns the control points of every markup in a .mrk.json (Fiducial, Curve, ClosedCurve, Line) or .fcsv file, in LPS
/// mm, whatever the file's own coordinate system; a ClosedCurve ends with its first point again. One list per markup
/// that has points; points that are not placed (positionStatus) are left out. Refused: no point at all, coordinates
/// that are not finite numbers, a unit other than mm.
std::vector<std::vector<Vec3>> readMarkups(const std::string& file);

/// Collects the targets and paths of a command line: typed points and markups files. The typed points of --pathPoint
/// form one path; every point of a target file is a target, every markup of a path file a path. Throws UsageError for a
/// typed path of one point or of length 0, InputError for such a path in a file.
Focus readFocus(const std::vector<Vec3>& targetPoints, const std::vector<std::string>& targetFiles,
                const Path& pathPoints, const std::vector<std::string>& pathFiles);

/// A plane or a box (ROI) of Slicer.
struct MarkupRegion
{
  Vec3 center;              ///< LPS, mm
  std::array<Vec3, 3> axes; ///< unit vectors, LPS; of a plane only the third is set, its normal
  Vec3 size;                ///< of a box, along its axes, mm
};

/// One markup with the positions, labels and measurements of its control points.
struct Markup
{
  std::vector<Vec3> points;                               ///< LPS, mm
  std::vector<std::string> labels;                        ///< by point; empty where it has none
  std::map<std::string, std::vector<double>> pointValues; ///< measurements with one value per point, by name
  std::string type;                                       ///< Slicer's word: "Fiducial", "Plane"; empty in .fcsv
  std::optional<MarkupRegion> region;                     ///< of types "Plane" and "ROI" that have one
};

/// Reads the same markups as readMarkups(), with labels and measurements. Leaves out measurements that do not have one
/// finite number for every point.
std::vector<Markup> readLabelledMarkups(const std::string& file);

} // namespace surgicalmesher
